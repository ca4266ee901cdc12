//! Problems with known solutions.

use std::f64::consts::{PI, TAU};

use super::*;

/// Errors follow tolerances down to 1e-13, forward and backward.
#[test]
fn the_oscillator_follows_its_tolerance() {
    for method in BOTH {
        for t_end in [20.0 * TAU, -20.0 * TAU] {
            let mut previous = f64::INFINITY;
            for value in [1e-4, 1e-7, 1e-10, 1e-13] {
                let mut integrator = Integrator::new(method, 2);
                let run = integrator
                    .run(&mut smooth(oscillate), 0.0, &[1.0, 0.0], t_end, &tolerance(&value))
                    .unwrap();
                let error = largest_difference(&run.y, &[1.0, 0.0]);
                println!("{method:?} {value:.0e}: {error:.2e} {:?}", run.statistics);
                assert_eq!(run.end, End::Reached);
                assert_eq!(run.t, t_end);
                assert!(error < 1e3 * value && error < previous, "{method:?} {value:e}: {error:e}");
                previous = error;
            }
        }
    }
}

#[test]
fn kepler_orbits_close() {
    // Eccentricity 0.6, a = 1: 20 turns of 2π each.
    let start = [0.4, 0.0, 0.0, 2.0];
    for (method, value, bound) in
        [(BOTH[0], 1e-10, 1e-5), (BOTH[1], 1e-10, 1e-5), (BOTH[1], 1e-13, 1e-8)]
    {
        let run = Integrator::new(method, 4)
            .run(&mut smooth(kepler), 0.0, &start, 20.0 * TAU, &tolerance(&value))
            .unwrap();
        let error = largest_difference(&run.y, &start);
        println!("{method:?} {value:.0e}: {error:.2e} {:?}", run.statistics);
        assert!(error < bound, "{method:?} {value:e}: {error:e}");
        let s = run.statistics;
        assert!(s.smallest.unwrap() < 0.5 * s.largest.unwrap(), "steps adapt");
    }
}

/// Energy over 1000 turns on an ellipse, as a stand-in for a conservative linkage.
#[test]
fn energy_drifts_little_in_a_thousand_turns() {
    let start = [0.4, 0.0, 0.0, 2.0];
    let energy = |y: &[f64]| 0.5 * (y[2] * y[2] + y[3] * y[3]) - 1.0 / y[0].hypot(y[1]);
    let value = 1e-12;
    let run = Integrator::new(Method::DormandPrince853, 4)
        .run(&mut smooth(kepler), 0.0, &start, 1000.0 * TAU, &tolerance(&value))
        .unwrap();
    let drift = (energy(&run.y) / energy(&start) - 1.0).abs();
    println!("kepler 1000 turns: {drift:.2e} {:?}", run.statistics);
    assert!(drift < 1e-8, "{drift:e}");
}

/// Linkage-like: J(q)q'' + ½J'(q)q'² = 0 with J = 1 + 0.5 cos q turns for ever.
#[test]
fn a_free_linkage_keeps_its_energy_for_a_thousand_turns() {
    let rates = |_: f64, y: &[f64], rates: &mut [f64]| {
        let (sine, cosine) = y[0].sin_cos();
        let (inertia, slope) = (1.0 + 0.5 * cosine, -0.5 * sine);
        rates[0] = y[1];
        rates[1] = -0.5 * slope * y[1] * y[1] / inertia;
    };
    let energy = |y: &[f64]| (1.0 + 0.5 * y[0].cos()) * y[1] * y[1];
    for method in BOTH {
        let value = 1e-12;
        let run = Integrator::new(method, 2)
            .run(
                &mut smooth(rates),
                0.0,
                &[0.0, TAU],
                810.0,
                &Options { relative: &[0.0, value], absolute: &[value], ..Options::default() },
            )
            .unwrap();
        let drift = (energy(&run.y) / energy(&[0.0, TAU]) - 1.0).abs();
        println!("{method:?} {:.0} turns: {drift:.2e} {:?}", run.y[0] / TAU, run.statistics);
        assert!(run.y[0] > 1000.0 * TAU && drift < 1e-9, "{method:?}: {drift:e}");
    }
}

#[test]
fn a_large_swing_of_a_pendulum_has_its_period() {
    // Arithmetic-geometric mean: T = 2π / agm(1, cos(θ₀/2)), here from 170°.
    let amplitude = 170.0 * PI / 180.0;
    let (mut a, mut g) = (1.0_f64, (0.5 * amplitude).cos());
    for _ in 0..10 {
        (a, g) = (0.5 * (a + g), (a * g).sqrt());
    }
    let rates = |_: f64, y: &[f64], rates: &mut [f64]| {
        rates[0] = y[1];
        rates[1] = -y[0].sin();
    };
    for method in BOTH {
        let value = 1e-12;
        let run = Integrator::new(method, 2)
            .run(&mut smooth(rates), 0.0, &[amplitude, 0.0], TAU / a, &tolerance(&value))
            .unwrap();
        let error = largest_difference(&run.y, &[amplitude, 0.0]);
        println!("pendulum {method:?}: {error:.2e}");
        assert!(error < 1e-10, "{method:?}: {error:e}");
    }
}

/// The same problem in other units is solved equally well.
#[test]
fn tiny_and_huge_scales_do_no_harm() {
    for (time, size) in [(1e-8, 1e8), (1e8, 1e-8), (1e-8, 1e-8), (1e8, 1e8), (1e-150, 1.0)] {
        let rates = move |_: f64, y: &[f64], rates: &mut [f64]| {
            rates[0] = y[1] / time;
            rates[1] = -y[0] / time;
        };
        for method in BOTH {
            let options = Options { absolute: &[0.0], ..Options::default() };
            let run = Integrator::new(method, 2)
                .run(&mut smooth(rates), 0.0, &[size, 0.0], TAU * time, &options)
                .unwrap();
            let error = largest_difference(&run.y, &[size, 0.0]) / size;
            assert!(error < 1e-8, "{method:?} {time:e} {size:e}: {error:e}");
            assert!(run.statistics.steps < 800, "{:?}", run.statistics);
        }
    }
}

/// One absolute tolerance for all would be dominated by the largest of unequal components.
#[test]
fn each_component_has_its_own_tolerance() {
    let rates = |t: f64, _: &[f64], rates: &mut [f64]| {
        rates[0] = t.cos();
        rates[1] = 1e6 * (37.0 * t).cos();
    };
    let run = |absolute: &[f64]| {
        let options = Options { relative: &[1e-14], absolute, ..Options::default() };
        Integrator::new(Method::DormandPrince853, 2)
            .run(&mut smooth(rates), 0.0, &[0.0, 0.0], 3.0, &options)
            .unwrap()
    };
    let both = run(&[1e-9, 1e-9]).statistics.steps;
    let first = run(&[1e-9, f64::INFINITY]);
    assert!(first.statistics.steps * 5 < both, "{} {both}", first.statistics.steps);
    assert!((first.y[0] - 3.0_f64.sin()).abs() < 1e-8);
}

#[test]
fn any_number_of_equations_works() {
    // A chain of n: y₀' = −y₀, yᵢ' = yᵢ₋₁ − yᵢ: the Poisson terms tⁱ/i!·e⁻ᵗ.
    for n in [1, 3, 4, 5, 8, 11] {
        let rates = |_: f64, y: &[f64], rates: &mut [f64]| {
            rates[0] = -y[0];
            for i in 1..y.len() {
                rates[i] = y[i - 1] - y[i];
            }
        };
        let mut y = vec![0.0; n];
        y[0] = 1.0;
        let run = Integrator::new(Method::DormandPrince853, n)
            .run(&mut smooth(rates), 0.0, &y, 2.0, &Options::default())
            .unwrap();
        let mut term = (-2.0_f64).exp();
        for (i, y) in run.y.iter().enumerate() {
            assert!((y - term).abs() < 1e-11, "n = {n}, component {i}: {y} {term}");
            term *= 2.0 / (i as f64 + 1.0);
        }
    }
}

#[test]
fn output_between_steps_is_as_good_as_the_steps() {
    let times: Vec<f64> = (0..=1000).map(|i| 0.02 * f64::from(i)).collect();
    for (method, bound) in [(BOTH[0], 3e-9), (BOTH[1], 3e-9)] {
        for direction in [1.0, -1.0] {
            let times: Vec<f64> = times.iter().map(|t| direction * t).collect();
            let mut integrator = Integrator::new(method, 2);
            let mut run = |output| {
                let options = Options { output, ..Options::default() };
                integrator
                    .run(&mut smooth(oscillate), 0.0, &[0.0, 1.0], direction * 20.0, &options)
                    .unwrap()
            };
            let sampled = run(Output::At(&times));
            let dense = run(Output::Dense);
            assert_eq!(sampled.samples.len(), 2 * times.len());
            let mut worst: f64 = 0.0;
            for (t, y) in times.iter().zip(sampled.samples.chunks(2)) {
                worst = worst.max(largest_difference(y, &[t.sin(), t.cos()]));
                let mut at = [0.0; 2];
                assert!(dense.dense.at(*t, &mut at));
                assert_eq!(at, y, "t = {t}");
            }
            println!("{method:?}: {worst:.2e}, {} steps", dense.dense.ends().len());
            assert!(worst < bound, "{method:?}: {worst:e}");
            let mut at = [0.0; 2];
            assert!(!dense.dense.at(direction * 20.1, &mut at) && at[0].is_nan());
            assert!(!dense.dense.at(-direction * 0.1, &mut at) && at[0].is_nan());
            assert!(!dense.dense.at(f64::NAN, &mut at) && at[0].is_nan());
            assert_eq!(dense.dense.ends().len() as u64, dense.statistics.steps);
        }
    }
}

/// A run reuses the workspace of earlier runs, but not its contents.
#[test]
fn runs_do_not_depend_on_earlier_runs() {
    for method in BOTH {
        let run = |integrator: &mut Integrator| {
            integrator.run(&mut smooth(oscillate), 0.0, &[0.3, 1.0], 7.0, &Options::default())
        };
        let mut used = Integrator::new(method, 2);
        let far = [1e30, -1e30];
        used.run(&mut smooth(oscillate), 5.0, &far, 1.0, &Options::default()).unwrap();
        assert_eq!(run(&mut used), run(&mut Integrator::new(method, 2)));
    }
}
