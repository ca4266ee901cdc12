//! Groups above class II, solved: by what no solver knows, and with each set of instructions.

use std::f64::consts::TAU;

use assur::{Control, Coordinates, Description, Mechanism, Motion, Outputs, Request, Simd, Status};

use crate::models::linkages::{class_iv, triad};

/// Of the greatest length: rigid links stay as long as they are, and so do their analogues'
/// parts along them.
const RIGID: f64 = 1e-11;
/// Step of differences, rad.
const STEP: f64 = 4e-3;
/// Of the greatest value of those that are subtracted: a group's position is good to some u κ.
const ROUNDING: f64 = 1e-12;

/// Class V: rocker, bar, rocker, bar and plate make a closed pentagon.
fn pentagon() -> Description {
    let joints = [
        ("O", [0.0, 0.0]),
        ("A", [0.12, 0.1]),
        ("B", [1.9, 2.9]),
        ("C", [0.6, 1.9]),
        ("D", [2.4, 3.4]),
        ("P", [2.0, 0.9]),
        ("Q", [3.6, 1.2]),
        ("R", [3.3, 2.2]),
        ("E", [0.5, 0.5]),
        ("F", [4.2, 0.2]),
    ];
    let links = [
        ("ground", vec!["O", "E", "F"]),
        ("crank", vec!["O", "A"]),
        ("rod", vec!["A", "C"]),
        ("left", vec!["E", "P", "B"]),
        ("right", vec!["F", "Q", "R"]),
        ("lower", vec!["P", "Q"]),
        ("plate", vec!["B", "C", "D"]),
        ("upper", vec!["D", "R"]),
    ];
    let drawn = joints.iter().fold(Description::new(), |d, (name, at)| d.joint(name, *at));
    links.into_iter().fold(drawn, |d, (name, on)| d.link(name, on)).driver("crank")
}

fn cases() -> [(usize, Mechanism); 3] {
    [(3, triad()), (4, class_iv()), (5, pentagon())].map(|(class, description)| {
        let mechanism = Mechanism::new(&description).expect("a mechanism");
        assert_eq!(mechanism.structure().groups.iter().map(|g| g.class).max(), Some(class));
        (class, mechanism)
    })
}

fn solve(mechanism: &Mechanism, q: &[f64], order: usize, simd: Simd) -> Motion {
    let request = Request {
        dimensions: mechanism.drawing(),
        coordinates: Coordinates::Shared(q),
        signs: mechanism.signs(),
        order,
        outputs: &Outputs::all(mechanism),
    };
    let control = Control { simd, ..Control::default() };
    mechanism.solve_with(&request, &control).expect("a motion")
}

/// Half a radian to either side of the drawing, as far as it goes.
fn coordinates(mechanism: &Mechanism) -> Vec<f64> {
    (-50..=50).map(|k| mechanism.q0()[0] + 0.01 * f64::from(k)).collect()
}

/// The derivatives of |b − a|² by q, order by order, are zero on a rigid link (Leibniz's rule).
#[test]
fn links_stay_rigid_to_the_third_analogue() {
    for (class, mechanism) in cases() {
        let q = coordinates(&mechanism);
        let motion = solve(&mechanism, &q, 3, Simd::default());
        let drawn = solve(&mechanism, mechanism.q0(), 0, Simd::default());
        let good: Vec<usize> =
            (0..q.len()).filter(|&i| motion.status[i] == Status::Ok as u8).collect();
        assert!(good.len() > 60, "class {class}: {} positions", good.len());
        for link in &mechanism.linkage().links {
            for pair in link.joints.windows(2) {
                let between = |motion: &Motion, order: usize, i: usize| {
                    [0, 1].map(|axis| {
                        let at =
                            |joint: usize| motion.joints[joint].derivatives[order][2 * i + axis];
                        at(pair[1]) - at(pair[0])
                    })
                };
                let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
                let span = between(&drawn, 0, 0);
                let square = dot(span, span);
                for &i in &good {
                    let [d0, d1, d2, d3] = [0, 1, 2, 3].map(|order| between(&motion, order, i));
                    let derivatives = [
                        (dot(d0, d0) - square, square),
                        (dot(d0, d1), dot(d0, d0).sqrt() * dot(d1, d1).sqrt()),
                        (
                            dot(d1, d1) + dot(d0, d2),
                            dot(d1, d1) + (dot(d0, d0) * dot(d2, d2)).sqrt(),
                        ),
                        (
                            3.0 * dot(d1, d2) + dot(d0, d3),
                            3.0 * (dot(d1, d1) * dot(d2, d2)).sqrt()
                                + (dot(d0, d0) * dot(d3, d3)).sqrt(),
                        ),
                    ];
                    for (order, (miss, size)) in derivatives.into_iter().enumerate() {
                        assert!(
                            miss.abs() <= RIGID * size.max(1e-3 * square),
                            "class {class}, {} at {}, order {order}: {miss} of {size}",
                            link.name,
                            q[i]
                        );
                    }
                }
            }
        }
    }
}

/// Analogues are the derivatives of the positions: central differences of the fourth order, whose
/// error two widths tell.
#[test]
fn analogues_are_derivatives() {
    const AROUND: [f64; 6] = [-4.0, -2.0, -1.0, 1.0, 2.0, 4.0];
    for (class, mechanism) in cases() {
        let at: Vec<f64> = coordinates(&mechanism).into_iter().step_by(5).collect();
        let motion = solve(&mechanism, &at, 3, Simd::default());
        let around: Vec<f64> = at.iter().flat_map(|q| AROUND.map(|k| q + k * STEP)).collect();
        let beside = solve(&mechanism, &around, 2, Simd::default());
        let mut compared = 0;
        for i in 0..at.len() {
            let few = 6 * i..6 * i + 6;
            let good = |status: &[u8]| status.iter().all(|&s| s == Status::Ok as u8);
            if !good(&motion.status[i..=i]) || !good(&beside.status[few.clone()]) {
                continue;
            }
            compared += 1;
            for (own, other) in motion.links.iter().zip(&beside.links) {
                for order in 1..=3 {
                    let f = &other.derivatives[order - 1][few.clone()];
                    let difference =
                        |far: f64, near: f64, step: f64| (8.0 * near - far) / (12.0 * step);
                    let fine = difference(f[4] - f[1], f[3] - f[2], STEP);
                    let rough = difference(f[5] - f[0], f[4] - f[1], 2.0 * STEP);
                    let analogue = own.derivatives[order][i];
                    let size = f.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
                    // The error of the wider is 16 times that of the other.
                    let allowed = (rough - fine).abs() / 8.0 + ROUNDING * size / STEP;
                    assert!(
                        (fine - analogue).abs() <= allowed,
                        "class {class}, link {}, order {order} at {}: {fine} {analogue} {allowed}",
                        own.index,
                        at[i]
                    );
                }
            }
        }
        assert!(compared > 10, "class {class}: {compared}");
    }
}

/// Ten turns; what is beyond a fold has its status and NaN with each of them.
#[test]
fn every_set_of_instructions_gives_the_same_bits() {
    let bits = |motion: &Motion| -> Vec<u64> {
        let tracks = [&motion.joints, &motion.links, &motion.slides].into_iter().flatten();
        // The sign of "not a number" says nothing, and processors differ in it.
        let bits = |x: &f64| if x.is_nan() { u64::MAX } else { x.to_bits() };
        tracks.flat_map(|t| t.derivatives.iter().flatten().map(bits)).collect()
    };
    for (class, mechanism) in cases() {
        let q: Vec<f64> = (0..200).map(|k| 0.05 * TAU * f64::from(k)).collect();
        let baseline = solve(&mechanism, &q, 3, Simd::Baseline);
        for simd in [Simd::Avx2, Simd::Avx512] {
            if simd > Simd::best() {
                println!("skipped: this processor has no {}", simd.name());
                continue;
            }
            let other = solve(&mechanism, &q, 3, simd);
            assert_eq!(other.status, baseline.status, "class {class}, {}", simd.name());
            assert!(bits(&other) == bits(&baseline), "class {class}, {}", simd.name());
        }
    }
}
