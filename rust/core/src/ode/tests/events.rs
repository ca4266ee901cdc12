//! Events compared with known solutions.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::*;

/// A smooth system with event functions, and the action at each event (from its number and the
/// count of events so far).
struct Watched<F, G, A> {
    rates: F,
    events: G,
    act: A,
    count: usize,
}

impl<F, G, A> System for Watched<F, G, A>
where
    F: Fn(f64, &[f64], &mut [f64]),
    G: Fn(f64, &[f64], &mut [f64]),
    A: Fn(usize, usize, &mut [f64]) -> Action,
{
    type Error = Infallible;

    fn rates(&mut self, t: f64, y: &[f64], rates: &mut [f64]) -> Result<(), Fault<Infallible>> {
        (self.rates)(t, y, rates);
        Ok(())
    }

    fn events(&mut self, t: f64, y: &[f64], values: &mut [f64]) -> Result<(), Infallible> {
        (self.events)(t, y, values);
        Ok(())
    }

    fn on_event(&mut self, event: usize, _: f64, y: &mut [f64]) -> Result<Action, Infallible> {
        self.count += 1;
        Ok((self.act)(event, self.count, y))
    }
}

fn go_on(_: usize, _: usize, _: &mut [f64]) -> Action {
    Action::Continue
}

fn tight(events: &[Crossing]) -> Options<'_> {
    Options { relative: &[1e-12], absolute: &[1e-13], events, ..Options::default() }
}

/// Times of one event.
fn times(run: &Solution, index: usize) -> Vec<f64> {
    run.events.iter().filter(|event| event.index == index).map(|event| event.t).collect()
}

fn assert_times(actual: &[f64], exact: &[f64], bound: f64) {
    assert_eq!(actual.len(), exact.len(), "{actual:?} {exact:?}");
    let worst = largest_difference(actual, exact);
    println!("{} events, worst {worst:.1e}", actual.len());
    assert!(worst < bound, "{worst:e}: {actual:?} {exact:?}");
}

/// sin t = 0.5 upwards and downwards, both, and where cos t = 0; forward and backward.
#[test]
fn events_of_the_oscillator_are_located() {
    let kinds = [Crossing::Rising, Crossing::Falling, Crossing::Either, Crossing::Either];
    for method in BOTH {
        for direction in [1.0, -1.0] {
            let mut system = Watched {
                rates: oscillate,
                events: |_: f64, y: &[f64], g: &mut [f64]| {
                    g.copy_from_slice(&[y[0] - 0.5, y[0] - 0.5, y[0] - 0.5, y[1]]);
                },
                act: go_on,
                count: 0,
            };
            let run = Integrator::new(method, 2)
                .run(&mut system, 0.0, &[0.0, 1.0], direction * 20.0, &tight(&kinds))
                .unwrap();
            // sin(t) = 0.5 at 30° and 150°, and backward at −210° (rising in that direction) and
            // −330°.
            let (up, down) = if direction > 0.0 {
                (PI / 6.0, 5.0 * PI / 6.0)
            } else {
                (7.0 * PI / 6.0, 11.0 * PI / 6.0)
            };
            let each = |first: f64| -> Vec<f64> {
                (0..9)
                    .map(|turn| first + TAU * f64::from(turn))
                    .filter(|t| *t < 20.0)
                    .map(|t| direction * t)
                    .collect()
            };
            assert_times(&times(&run, 0), &each(up), 1e-10);
            assert_times(&times(&run, 1), &each(down), 1e-10);
            let mut both = [each(up), each(down)].concat();
            both.sort_unstable_by(|a, b| (direction * a).total_cmp(&(direction * b)));
            assert_times(&times(&run, 2), &both, 1e-10);
            let rests: Vec<f64> =
                (0..6).map(|i| direction * (FRAC_PI_2 + PI * f64::from(i))).collect();
            assert_times(&times(&run, 3), &rests, 1e-10);
            assert!(run.events.is_sorted_by(|a, b| direction * a.t <= direction * b.t));
            for (i, event) in run.events.iter().enumerate() {
                let state = run.event_state(i).unwrap();
                assert!(largest_difference(state, &[event.t.sin(), event.t.cos()]) < 1e-10);
            }
        }
    }
}

#[test]
fn growth_doubles_at_ln_2_and_ends_there() {
    for method in BOTH {
        let mut system = Watched {
            rates: |_: f64, y: &[f64], r: &mut [f64]| r[0] = y[0],
            events: |_: f64, y: &[f64], g: &mut [f64]| g[0] = y[0] - 2.0,
            act: |_, _, _: &mut [f64]| Action::Stop,
            count: 0,
        };
        let options = Options { output: Output::Dense, ..tight(&[Crossing::Rising]) };
        let run = Integrator::new(method, 1).run(&mut system, 0.0, &[1.0], 3.0, &options).unwrap();
        let t = 2.0_f64.ln();
        assert!((run.t - t).abs() < 1e-12, "{:e}", run.t - t);
        assert_eq!(run.end, End::Event { index: 0, t: run.t });
        assert!((run.y[0] - 2.0).abs() < 1e-14);
        // Dense output ends there, in the state of the event.
        assert_eq!(run.dense.ends().last(), Some(&run.t));
        let mut at = [0.0];
        assert!(run.dense.at(run.t, &mut at) && (at[0] - 2.0).abs() < 1e-14, "{}", at[0]);
        assert!(!run.dense.at(run.t + 1e-10, &mut at));
    }
}

/// The rates are constant and the first step covers the run: all events lie in one step.
#[test]
fn events_of_one_step_come_in_order() {
    let thresholds = [0.7, 0.3, 0.3 + 1e-9, 5.0, 4.999];
    for method in BOTH {
        let mut system = Watched {
            rates: |_: f64, _: &[f64], r: &mut [f64]| r[0] = 1.0,
            events: |_: f64, y: &[f64], g: &mut [f64]| {
                for (g, threshold) in g.iter_mut().zip(thresholds) {
                    *g = y[0] - threshold;
                }
            },
            act: go_on,
            count: 0,
        };
        let options = Options { first_step: Some(10.0), ..tight(&[Crossing::Either; 5]) };
        let run = Integrator::new(method, 1).run(&mut system, 0.0, &[0.0], 10.0, &options).unwrap();
        assert_eq!(run.statistics.steps, 1);
        let order: Vec<usize> = run.events.iter().map(|event| event.index).collect();
        assert_eq!(order, [1, 2, 0, 4, 3]);
        for event in &run.events {
            assert!((event.t - thresholds[event.index]).abs() < 4e-15, "{event:?}");
        }
    }
}

/// The first of two simultaneous events restarts the run; the second is neither lost nor repeated.
#[test]
fn simultaneous_events_occur_once_each() {
    for method in BOTH {
        let mut system = Watched {
            rates: oscillate,
            events: |t: f64, y: &[f64], g: &mut [f64]| {
                g.copy_from_slice(&[y[1], 3.0 * y[1], FRAC_PI_2 - t, y[0] - 2.0]);
            },
            act: |_, _, _: &mut [f64]| Action::Restart,
            count: 0,
        };
        let options =
            tight(&[Crossing::Falling, Crossing::Either, Crossing::Falling, Crossing::Either]);
        let run =
            Integrator::new(method, 2).run(&mut system, 0.0, &[0.0, 1.0], 3.0, &options).unwrap();
        let mut order: Vec<usize> = run.events.iter().map(|event| event.index).collect();
        order.sort_unstable();
        assert_eq!(order, [0, 1, 2]);
        assert!(run.events.iter().all(|event| (event.t - FRAC_PI_2).abs() < 1e-11));
        assert!((run.y[0] - 3.0_f64.sin()).abs() < 1e-10);
    }
}

#[test]
fn a_start_at_zero_is_an_event_only_outside_a_boundary() {
    let run = |kind: Crossing, slope: f64, start: f64| {
        let mut system = Watched {
            rates: move |_: f64, _: &[f64], r: &mut [f64]| r[0] = slope,
            events: |_: f64, y: &[f64], g: &mut [f64]| g[0] = y[0],
            act: |_, _, _: &mut [f64]| Action::Restart,
            count: 0,
        };
        let run = Integrator::new(Method::DormandPrince853, 1)
            .run(&mut system, 1.0, &[start], 2.0, &tight(&[kind]))
            .unwrap();
        assert_eq!(run.end, End::Reached);
        times(&run, 0)
    };
    for slope in [1.0, -1.0] {
        for kind in [Crossing::Rising, Crossing::Falling, Crossing::Either] {
            assert!(run(kind, slope, 0.0).is_empty());
        }
    }
    assert!(run(Crossing::Boundary, 1.0, 0.0).is_empty());
    assert_eq!(run(Crossing::Boundary, -1.0, 0.0), [1.0]);
    assert_eq!(run(Crossing::Boundary, -1.0, -0.5), [1.0]);
    // A start inside by less than its rounding leaves at once, with one event.
    assert_eq!(run(Crossing::Boundary, -1.0, 1e-18).len(), 1);
}

/// cos t ≥ 1 − depth only near whole turns: two roots in far less than a step.
#[test]
fn finds_pairs_of_roots_inside_a_step() {
    for (method, tolerance) in [(BOTH[0], 1e-6), (BOTH[1], 1e-6), (BOTH[1], 1e-11)] {
        for depth in [1e-2, 1e-4, 1e-5] {
            let mut system = Watched {
                // The phase is exact, so that only the search is tested.
                rates: |t: f64, _: &[f64], r: &mut [f64]| {
                    r[0] = -t.sin();
                    r[1] = t.cos();
                },
                events: |_: f64, y: &[f64], g: &mut [f64]| g[0] = y[0] - (1.0 - depth),
                act: go_on,
                count: 0,
            };
            let list = [tolerance];
            let options = Options {
                relative: &list,
                absolute: &list,
                events: &[Crossing::Either],
                ..Options::default()
            };
            let run = Integrator::new(method, 2)
                .run(&mut system, 1.0, &[1.0_f64.cos(), 1.0_f64.sin()], 1.0 + 50.0 * TAU, &options)
                .unwrap();
            println!("{method:?} {depth:e}: {} of 100", run.events.len());
            if tolerance < 0.01 * depth {
                assert_eq!(run.events.len(), 100, "{method:?} {depth:e}");
            }
        }
    }
}

#[test]
fn a_bouncing_ball_hits_the_ground_on_time() {
    let (g, restitution) = (9.81, 0.8_f64);
    for method in BOTH {
        let mut system = Watched {
            rates: |_: f64, y: &[f64], r: &mut [f64]| {
                r[0] = y[1];
                r[1] = -g;
            },
            events: |_: f64, y: &[f64], values: &mut [f64]| values[0] = y[0],
            act: |_, count, y: &mut [f64]| {
                y[1] *= -restitution;
                if count == 20 { Action::Stop } else { Action::Restart }
            },
            count: 0,
        };
        let options = tight(&[Crossing::Falling]);
        let run =
            Integrator::new(method, 2).run(&mut system, 0.0, &[1.0, 0.0], 9.0, &options).unwrap();
        let fall = (2.0_f64 / g).sqrt();
        let exact: Vec<f64> = (0..20)
            .map(|n| fall * (1.0 + 2.0 * (1..=n).map(|k| restitution.powi(k)).sum::<f64>()))
            .collect();
        assert_times(&times(&run, 0), &exact, 1e-12);
        assert!(run.y[1] > 0.0 && run.event_state(19).unwrap()[1] < 0.0);
    }
}

/// The quarter period of a pendulum: 2π/agm(1, cos(θ₀/2))/4.
#[test]
fn a_pendulum_passes_its_lowest_point_on_time() {
    let amplitude = 2.0_f64;
    let (mut a, mut g) = (1.0_f64, (0.5 * amplitude).cos());
    for _ in 0..10 {
        (a, g) = (0.5 * (a + g), (a * g).sqrt());
    }
    for method in BOTH {
        let mut system = Watched {
            rates: |_: f64, y: &[f64], r: &mut [f64]| {
                r[0] = y[1];
                r[1] = -y[0].sin();
            },
            events: |_: f64, y: &[f64], values: &mut [f64]| values.copy_from_slice(y),
            act: go_on,
            count: 0,
        };
        let options = tight(&[Crossing::Either, Crossing::Either]);
        let run = Integrator::new(method, 2)
            .run(&mut system, 0.0, &[amplitude, 0.0], 20.0, &options)
            .unwrap();
        let quarter = 0.25 * TAU / a;
        let lowest: Vec<f64> =
            (0..9).map(|i| quarter * f64::from(2 * i + 1)).filter(|t| *t < 20.0).collect();
        let rests: Vec<f64> =
            (1..9).map(|i| quarter * f64::from(2 * i)).filter(|t| *t < 20.0).collect();
        assert_times(&times(&run, 0), &lowest, 1e-10);
        assert_times(&times(&run, 1), &rests, 1e-10);
    }
}

/// Event functions that are undefined, jump, or almost touch zero.
#[test]
fn unusual_event_functions_do_no_harm() {
    for method in BOTH {
        let mut system = Watched {
            rates: |_: f64, _: &[f64], r: &mut [f64]| r[0] = 1.0,
            events: |t: f64, _: &[f64], g: &mut [f64]| {
                g[0] = if t < 0.4 { f64::NAN } else { t - 0.6 };
                g[1] = if t < 0.3 { -1.0 } else { 1.0 };
                g[2] = (t - 0.5).powi(2) + 1e-12;
                g[3] = f64::INFINITY;
                g[4] = f64::NAN;
                g[5] = (t - 0.21).cbrt();
            },
            act: go_on,
            count: 0,
        };
        let options = tight(&[Crossing::Either; 6]);
        let run = Integrator::new(method, 1).run(&mut system, 0.0, &[0.0], 1.0, &options).unwrap();
        assert_times(&times(&run, 0), &[0.6], 1e-14);
        assert_times(&times(&run, 1), &[0.3], 1e-14);
        assert_times(&times(&run, 5), &[0.21], 1e-14);
        assert_eq!(run.events.len(), 3);
    }
}

/// A function that jumps over zero at a break makes its event at the break.
#[test]
fn a_jump_at_a_break_is_an_event_there() {
    struct Jump(f64);
    impl System for Jump {
        type Error = Infallible;
        fn rates(&mut self, _: f64, _: &[f64], r: &mut [f64]) -> Result<(), Fault<Infallible>> {
            r[0] = self.0;
            Ok(())
        }
        fn begin_interval(&mut self, from: f64, to: f64, _: &[f64]) -> Result<(), Infallible> {
            self.0 = if 0.5 * (from + to) < 1.0 { -1.0 } else { 1.0 };
            Ok(())
        }
        fn events(&mut self, _: f64, _: &[f64], values: &mut [f64]) -> Result<(), Infallible> {
            values[0] = self.0;
            Ok(())
        }
    }
    for (from, to, count) in [(0.0, 2.0, 1), (2.0, 0.0, 0)] {
        let options = Options { breaks: &[1.0], ..tight(&[Crossing::Rising]) };
        let run = Integrator::new(Method::DormandPrince853, 1)
            .run(&mut Jump(0.0), from, &[0.0], to, &options)
            .unwrap();
        assert_eq!(times(&run, 0), vec![1.0; count]);
        assert!(run.y[0].abs() < 1e-15);
    }
}

/// Output before an event that changes the state does not depend on what follows.
#[test]
fn output_stops_and_starts_at_restarts() {
    let output_times = [0.25, 0.5, 0.75, 1.0];
    let run = |output| {
        let mut system = Watched {
            rates: |_: f64, _: &[f64], r: &mut [f64]| r[0] = 1.0,
            events: |t: f64, _: &[f64], g: &mut [f64]| g[0] = t - 0.5,
            act: |_, _, y: &mut [f64]| {
                y[0] += 10.0;
                Action::Restart
            },
            count: 0,
        };
        let options = Options { output, ..tight(&[Crossing::Rising]) };
        Integrator::new(Method::DormandPrince853, 1)
            .run(&mut system, 0.0, &[0.0], 1.0, &options)
            .unwrap()
    };
    let exact = [0.25, 0.5, 10.75, 11.0];
    let sampled = run(Output::At(&output_times));
    assert!(largest_difference(&sampled.samples, &exact) < 1e-14, "{:?}", sampled.samples);
    let dense = run(Output::Dense).dense;
    for (t, y) in output_times.iter().zip(exact) {
        let mut at = [0.0];
        assert!(dense.at(*t, &mut at) && (at[0] - y).abs() < 1e-14, "{t}: {at:?}");
    }
}

/// A step that an event cuts ends with the rates there, and begins with its own rates, however short the rest
/// is.
#[test]
fn steps_cut_by_events_end_with_the_rates_there() {
    for method in BOTH {
        let run = |places: &[f64]| {
            let mut system = Watched {
                rates: oscillate,
                events: |t: f64, _: &[f64], values: &mut [f64]| {
                    values.iter_mut().zip(places).for_each(|(value, place)| *value = t - place);
                },
                act: |_: usize, _: usize, _: &mut [f64]| Action::Restart,
                count: 0,
            };
            let crossings = vec![Crossing::Rising; places.len()];
            let options = Options {
                relative: &[1e-5],
                absolute: &[1e-5],
                events: &crossings,
                output: Output::Dense,
                ..Options::default()
            };
            let run = Integrator::new(method, 2).run(&mut system, 0.0, &[0.0, 1.0], 6.0, &options);
            run.expect("a run")
        };
        let first = run(&[]).dense.ends()[1];
        for beside in [0.3, 0.03, 2e-3, 1e-4, 1e-6, 1e-9] {
            let solution = run(&[first + beside, 4.0]);
            assert_eq!(solution.events.len(), 2, "{method:?} {beside}");
            let (mut y, mut rates, mut exact_rates) = ([0.0; 2], [0.0; 2], [0.0; 2]);
            solution.dense.each_end(|t, y, rates| {
                oscillate(t, y, &mut exact_rates);
                assert!(
                    largest_difference(rates, &exact_rates) < 1e-13,
                    "{method:?} {beside} {t}: {rates:?}"
                );
            });
            assert!(solution.dense.slope(0.0, &mut rates) && rates == [1.0, 0.0]);
            for i in 0..=600 {
                let t = 0.01 * f64::from(i);
                assert!(solution.dense.at(t, &mut y) && solution.dense.slope(t, &mut rates));
                let exact = [t.sin(), t.cos()];
                assert!(largest_difference(&y, &exact) < 1e-3, "{method:?} {beside} {t}: {y:?}");
                let exact = [t.cos(), -t.sin()];
                assert!(largest_difference(&rates, &exact) < 1e-2, "{method:?} {t}: {rates:?}");
            }
        }
    }
}
