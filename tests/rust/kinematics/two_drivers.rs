//! Second derivatives by two drivers, whose dyads have kernels without checks.

use assur::{
    Checks, Control, Coordinates, Description, Mechanism, Motion, Outputs, Request, Simd, Status,
};

use crate::models::linkages;

/// A five-bar, and one whose point drives a rocker on the ground.
fn mechanisms() -> [Mechanism; 2] {
    let with_rocker = [
        ("A", [0.0, 0.0]),
        ("B", [0.3, 1.0]),
        ("C", [1.4, 2.0]),
        ("D", [2.5, 0.9]),
        ("E", [2.0, 0.0]),
        ("F", [3.0, 2.5]),
        ("G", [4.0, 0.5]),
    ]
    .into_iter()
    .fold(Description::new(), |d, (name, at)| d.joint(name, at))
    .link("ground", ["A", "E", "G"])
    .link("left", ["A", "B"])
    .link("l2", ["B", "C"])
    .link("l3", ["C", "D"])
    .link("right", ["E", "D"])
    .link("rod", ["C", "F"])
    .link("rocker", ["F", "G"])
    .driver("left")
    .driver("right");
    [linkages::five_bar(&["left", "right"]), with_rocker]
        .map(|description| Mechanism::new(&description).expect("a mechanism"))
}

/// A grid about the drawing, far enough that some positions do not close and some dyads are nearly flat.
fn grid(mechanism: &Mechanism) -> Vec<f64> {
    let [left, right] = [mechanism.q0()[0], mechanism.q0()[1]];
    (0..437)
        .flat_map(|k| {
            let (i, j) = (f64::from(k % 23), f64::from(k / 23));
            [left + 0.17 * (i - 11.0), right + 0.19 * (j - 9.0)]
        })
        .collect()
}

fn bits(motion: &Motion, links: usize) -> Vec<u64> {
    let joints = motion.joints.iter().map(|track| &track.derivatives);
    // Angles themselves are followed in another way if all is checked.
    let angles = motion.links[..links].iter().map(|track| &track.derivatives);
    let all = joints.chain(angles).flat_map(|orders| orders.iter().flatten());
    all.map(|x| if x.is_nan() { u64::MAX } else { x.to_bits() }).collect()
}

#[test]
fn the_path_without_checks_has_the_bits_of_the_other() {
    for mechanism in mechanisms() {
        let q = grid(&mechanism);
        let all = Outputs::all(&mechanism);
        for outputs in [Outputs { joints: all.joints.clone(), ..Outputs::default() }, all] {
            let request = Request {
                dimensions: mechanism.drawing(),
                coordinates: Coordinates::Shared(&q),
                signs: mechanism.signs(),
                order: 2,
                outputs: &outputs,
            };
            let solve = |checks, simd| {
                let control = Control { checks, simd, ..Control::default() };
                let motion = mechanism.solve_with(&request, &control).expect("a motion");
                (bits(&motion, outputs.links.len()), motion.status)
            };
            let expected = solve(Checks::Always, Simd::Baseline);
            let is_good = |status: &&u8| **status == Status::Ok as u8;
            let solved = expected.1.iter().filter(is_good).count();
            assert!((50..400).contains(&solved), "{solved} positions");
            for simd in [Simd::Baseline, Simd::Avx2, Simd::Avx512] {
                assert!(solve(Checks::Needed, simd) == expected, "{simd:?}");
            }
        }
    }
}
