//! The search for a linkage that draws a path.

use std::f64::consts::TAU;
use std::num::NonZeroUsize;
use std::sync::atomic::AtomicBool;

use assur::{
    Coordinates, FoundLinkage, Mechanism, Outputs, PathSearch, Request, SearchRequest, Simd,
};

/// A hook, in one stroke.
const HOOK: [[f64; 2]; 4] = [[0.0, 2.0], [0.0, 0.5], [0.4, 0.0], [1.2, 0.2]];

fn searched(threads: usize, simd: Simd) -> Vec<FoundLinkage> {
    let request = SearchRequest {
        is_closed: false,
        joints: 9,
        least_apex: 0.2,
        frame: 10.0,
        least_arc: TAU / 4.0,
        joint_price: 0.0,
        seed: 1,
        threads: NonZeroUsize::new(threads),
        simd,
    };
    let go_on = AtomicBool::new(false);
    let mut search = PathSearch::new(&HOOK, request).expect("a path");
    search.start(&go_on);
    for is_apart in [true, false, false] {
        assert!(search.round(is_apart, &go_on));
    }
    search.finish(&go_on)
}

#[test]
fn same_bits_on_any_number_of_threads_and_level() {
    let one = searched(1, Simd::best());
    for other in [searched(2, Simd::best()), searched(2, Simd::Baseline)] {
        assert_eq!(one.len(), other.len());
        for (one, other) in one.iter().zip(&other) {
            assert_eq!(one.description, other.description);
            assert_eq!((one.arc, one.value), (other.arc, other.value));
        }
    }
}

/// Distance from a point to a polyline.
fn distance(point: [f64; 2], line: &[[f64; 2]]) -> f64 {
    let to = |ends: &[[f64; 2]]| {
        let [along, off] =
            [[ends[1], ends[0]], [point, ends[0]]].map(|[a, b]| [a[0] - b[0], a[1] - b[1]]);
        let part = (off[0] * along[0] + off[1] * along[1])
            / (along[0] * along[0] + along[1] * along[1]).max(f64::MIN_POSITIVE);
        let part = part.clamp(0.0, 1.0);
        (off[0] - part * along[0]).hypot(off[1] - part * along[1])
    };
    line.windows(2).map(to).fold(f64::INFINITY, f64::min)
}

/// The solver is the judge: what is found turns fully and draws the path.
#[test]
fn what_is_found_moves_and_draws() {
    for found in searched(2, Simd::best()).iter().take(3) {
        let mechanism = Mechanism::new(&found.description).expect("a mechanism");
        let joints = &found.description.joints;
        let [(_, pivot), (_, pin)] = &joints[..2] else { panic!("a crank") };
        let start = (pin[1] - pivot[1]).atan2(pin[0] - pivot[0]);
        let solve = |turn: f64| {
            let q: Vec<f64> = (0..=1000).map(|k| start + turn * f64::from(k) / 1000.0).collect();
            mechanism.solve(&Request {
                dimensions: mechanism.drawing(),
                coordinates: Coordinates::Shared(&q),
                signs: mechanism.signs(),
                order: 0,
                outputs: &Outputs::all(&mechanism),
            })
        };
        solve(TAU).expect("a full turn");
        let motion = solve(found.arc).expect("the path");
        let traced = &motion.joints.last().expect("the traced joint").derivatives[0];
        let curve: Vec<[f64; 2]> = traced.chunks(2).map(|at| [at[0], at[1]]).collect();
        let mean = |points: &[[f64; 2]], line: &[[f64; 2]]| {
            points.iter().map(|&at| distance(at, line)).sum::<f64>() / points.len() as f64
        };
        let error = mean(&curve, &HOOK) + mean(&HOOK, &curve);
        assert!(error < 0.05, "{error}");
    }
}

#[test]
fn no_path_is_refused() {
    let request = SearchRequest {
        is_closed: true,
        joints: 9,
        least_apex: 0.2,
        frame: 10.0,
        least_arc: 1.6,
        joint_price: 0.0,
        seed: 0,
        threads: None,
        simd: Simd::best(),
    };
    for points in [&[][..], &[[1.0, 1.0]; 3], &[[0.0, f64::NAN], [1.0, 0.0]]] {
        assert!(PathSearch::new(points, request).is_none());
    }
}
