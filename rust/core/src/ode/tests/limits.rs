//! Runs that end early or are refused.

use std::f64::consts::TAU;

use super::*;

fn run<S: System>(
    method: Method,
    system: &mut S,
    (from, to): (f64, f64),
    y: &[f64],
    options: &Options,
) -> Result<Solution, Error<S::Error>> {
    Integrator::new(method, y.len()).run(system, from, y, to, options)
}

type Fallible = Result<(), Fault<Infallible>>;

/// y = 1 is reached at t = 1 with y' = 1, at 2/3 with y' = 1/√(1 − y), and at π/2 with y' = √(1 −
/// y²).
#[test]
fn a_run_ends_at_the_domain_boundary() {
    let regular = |_: f64, y: &[f64], r: &mut [f64]| -> Fallible {
        r[0] = 1.0;
        if y[0] > 1.0 { Err(Fault::OutOfDomain) } else { Ok(()) }
    };
    let singular = |_: f64, y: &[f64], r: &mut [f64]| -> Fallible {
        r[0] = 1.0 / (1.0 - y[0]).sqrt();
        if y[0] >= 1.0 { Err(Fault::OutOfDomain) } else { Ok(()) }
    };
    for method in BOTH {
        for output in [Output::End, Output::Dense] {
            let options = Options { output, ..Options::default() };
            let end = run(method, &mut Rates(regular), (0.0, 2.0), &[0.0], &options).unwrap();
            let End::DomainBoundary { t } = end.end else { panic!("{}", end.end) };
            println!("{method:?} regular: {:.1e}, {:?}", t - 1.0, end.statistics);
            assert!((t - 1.0).abs() < 2e-15 && t == end.t, "{:e}", t - 1.0);

            let end = run(method, &mut Rates(singular), (0.0, 2.0), &[0.0], &options).unwrap();
            println!("{method:?} singular: {:.1e}, {:?}", end.t - 2.0 / 3.0, end.statistics);
            let End::DomainBoundary { t } = end.end else { panic!("{}", end.end) };
            assert!((t - 2.0 / 3.0).abs() < 1e-9, "{:e}", t - 2.0 / 3.0);
        }
        let backward = |_: f64, y: &[f64], r: &mut [f64]| -> Fallible {
            r[0] = 1.0;
            if y[0] < -1.0 { Err(Fault::OutOfDomain) } else { Ok(()) }
        };
        let options = Options::default();
        let end = run(method, &mut Rates(backward), (5.0, 0.0), &[0.0], &options).unwrap();
        assert!(
            matches!(end.end, End::DomainBoundary { t } if (t - 4.0).abs() < 1e-14),
            "{}",
            end.end
        );
        // Without a valid state the run ends where it begins.
        let none = |_: f64, _: &[f64], _: &mut [f64]| -> Fallible { Err(Fault::OutOfDomain) };
        let end = run(method, &mut Rates(none), (5.0, 0.0), &[3.0], &options).unwrap();
        assert_eq!((end.end, end.y), (End::DomainBoundary { t: 5.0 }, vec![3.0]));
        // Only the initial t is valid: the same, even at t = 0, where t has no spacing.
        let only = |t: f64, _: &[f64], r: &mut [f64]| -> Fallible {
            r[0] = 1.0;
            if t == 0.0 { Ok(()) } else { Err(Fault::OutOfDomain) }
        };
        let end = run(method, &mut Rates(only), (0.0, 1.0), &[3.0], &options).unwrap();
        assert_eq!(end.end, End::DomainBoundary { t: 0.0 });
    }
}

/// y = 1 − (1 − t)² up to t = 1, with steps that leave a quarter of the way until a thousandth is left.
struct Aiming;

impl System for Aiming {
    type Error = Infallible;

    fn rates(&mut self, t: f64, y: &[f64], rates: &mut [f64]) -> Fallible {
        rates[0] = 2.0 * (1.0 - y[0]).max(0.0).sqrt();
        if t > 1.0 { Err(Fault::OutOfDomain) } else { Ok(()) }
    }

    fn step_to_boundary(
        &mut self,
        t: f64,
        _: &[f64],
        last: Attempt,
    ) -> Result<Option<f64>, Infallible> {
        let left = 1.0 - t;
        let width = if left > 1e-3 { 0.75 * left } else { 0.0 };
        Ok(last.has_left_domain.then_some(width))
    }
}

#[test]
fn a_run_ends_where_its_system_says_that_the_boundary_is_reached() {
    for method in BOTH {
        let tolerances = (&[1e-4][..], &[1e-4][..]);
        let options =
            Options { relative: tolerances.0, absolute: tolerances.1, ..Options::default() };
        let end = run(method, &mut Aiming, (0.0, 9.0), &[0.0], &options).unwrap();
        let End::DomainBoundary { t } = end.end else { panic!("{}", end.end) };
        assert!(t < 1.0 && 1.0 - t <= 1e-3, "{t}");
        assert!((end.y[0] - (1.0 - (1.0 - t) * (1.0 - t))).abs() < 1e-3, "{}", end.y[0]);
        // Bisection alone takes some fifty.
        assert!(end.statistics.steps + end.statistics.rejected < 20, "{:?}", end.statistics);
    }
}

/// A slow component stays on its last number before the boundary; t and the other components would
/// go on for ever in steps that do not change it.
#[test]
fn a_stationary_component_has_reached_the_boundary() {
    let wall = 2.461_918_768_390_287_2;
    let slowing = |_: f64, y: &[f64], r: &mut [f64]| -> Fallible {
        (r[0], r[1]) = (y[1], -3.0);
        if y[0] > wall { Err(Fault::OutOfDomain) } else { Ok(()) }
    };
    for method in BOTH {
        let start = [wall - 1e-5, 0.02];
        let options = Options { max_steps: 10_000, ..Options::default() };
        let end = run(method, &mut Rates(slowing), (0.0, 1.0), &start, &options).unwrap();
        assert!(matches!(end.end, End::DomainBoundary { .. }), "{}", end.end);
        assert!((end.y[1] - (start[1] * start[1] - 6e-5_f64).sqrt()).abs() < 1e-8, "{:?}", end.y);
    }
}

/// Too wide a step leaves the domain, narrower ones do not.
#[test]
fn a_stage_outside_the_domain_is_not_the_boundary() {
    // Almost Torricelli's law: y' = −√y comes near zero, below which it is undefined.
    let rates = |_: f64, y: &[f64], r: &mut [f64]| -> Fallible {
        if y[0] < 0.0 {
            return Err(Fault::OutOfDomain);
        }
        r[0] = -y[0].sqrt();
        Ok(())
    };
    for method in BOTH {
        let options = Options { first_step: Some(1.99), ..Options::default() };
        let end = run(method, &mut Rates(rates), (0.0, 1.999), &[1.0], &options).unwrap();
        assert_eq!(end.end, End::Reached);
        assert!((end.y[0] - (0.5 * 0.001_f64).powi(2)).abs() < 1e-9);
        assert!(end.statistics.rejected > 0);
    }
}

#[test]
fn nan_is_an_error_that_says_where() {
    for bad in [f64::NAN, f64::INFINITY] {
        for method in BOTH {
            let late = move |t: f64, _: &[f64], r: &mut [f64]| {
                r.copy_from_slice(&[1.0, if t > 0.5 { bad } else { 0.0 }]);
            };
            let options = Options::default();
            let y = [0.0, 0.0];
            let error = run(method, &mut smooth(late), (0.0, 1.0), &y, &options).unwrap_err();
            let Error::NotFinite { t, component: 1 } = error else { panic!("{error}") };
            assert!(
                (t - 0.5).abs() < 1e-15 && error.to_string().contains("component 1"),
                "{error}"
            );
            let always = move |_: f64, _: &[f64], r: &mut [f64]| r.fill(bad);
            let error = run(method, &mut smooth(always), (0.2, 1.0), &y, &options).unwrap_err();
            assert_eq!(error, Error::NotFinite { t: 0.2, component: 0 });
        }
    }
}

#[test]
fn errors_of_the_system_pass_through() {
    #[derive(Debug, PartialEq)]
    struct Broken(f64);
    let broken = |t: f64, _: &[f64], r: &mut [f64]| {
        r[0] = 1.0;
        if t > 0.5 { Err(Fault::Error(Broken(t))) } else { Ok(()) }
    };
    for method in BOTH {
        let error =
            run(method, &mut Rates(broken), (0.0, 1.0), &[0.0], &Options::default()).unwrap_err();
        assert!(matches!(error, Error::System(Broken(t)) if t > 0.5));
    }
}

#[test]
fn the_step_limit_ends_the_run() {
    for method in BOTH {
        let options = Options { max_steps: 50, ..Options::default() };
        let end = run(method, &mut smooth(oscillate), (0.0, 1e6), &[1.0, 0.0], &options).unwrap();
        assert!(matches!(end.end, End::StepLimit { stiff: false, .. }), "{}", end.end);
        assert_eq!(end.statistics.steps + end.statistics.rejected, 50);
        assert!(largest_difference(&end.y, &[end.t.cos(), -end.t.sin()]) < 1e-8);
    }
}

/// Problem of Prothero and Robinson: y = cos t, with eigenvalue −10⁶.
#[test]
fn stiff_problems_are_reported() {
    let rates = |t: f64, y: &[f64], r: &mut [f64]| r[0] = -1e6 * (y[0] - t.cos()) - t.sin();
    for method in BOTH {
        let (relative, absolute) = (&[1e-4][..], &[1e-4][..]);
        let options = Options { relative, absolute, max_steps: 20_000, ..Options::default() };
        for output in [Output::End, Output::Dense] {
            let options = Options { output, ..options };
            let end = run(method, &mut smooth(rates), (0.0, 10.0), &[1.0], &options).unwrap();
            println!("{method:?}: {} {:?}", end.end, end.statistics);
            assert!(matches!(end.end, End::StepLimit { stiff: true, .. }), "{}", end.end);
            assert!(end.end.to_string().contains("stiff"));
        }
        let end =
            run(method, &mut smooth(oscillate), (0.0, 99.0 * TAU), &[1.0, 0.0], &options).unwrap();
        assert!(end.statistics.stiff * 10 < end.statistics.steps, "{:?}", end.statistics);
    }
}

/// y' = y²: y = 1/(1 − t) has no value at t = 1.
#[test]
fn a_pole_stalls_the_run() {
    for method in BOTH {
        let square = |_: f64, y: &[f64], r: &mut [f64]| r[0] = y[0] * y[0];
        let end =
            run(method, &mut smooth(square), (0.0, 2.0), &[1.0], &Options::default()).unwrap();
        println!("{method:?}: {} {:?}", end.end, end.statistics);
        assert!(matches!(end.end, End::Stalled { t } if (t - 1.0).abs() < 1e-8), "{}", end.end);
    }
}

#[test]
fn runs_can_be_cancelled() {
    struct Patience(u32);
    impl System for Patience {
        type Error = Infallible;
        fn rates(&mut self, t: f64, y: &[f64], r: &mut [f64]) -> Fallible {
            oscillate(t, y, r);
            Ok(())
        }
        fn cancelled(&mut self) -> bool {
            self.0 -= 1;
            self.0 == 0
        }
    }
    let y = [1.0, 0.0];
    let end = run(BOTH[1], &mut Patience(5), (0.0, 1e6), &y, &Options::default()).unwrap();
    assert!(matches!(end.end, End::Cancelled { t } if t > 0.0 && t < 1e3), "{}", end.end);
    let end = run(BOTH[1], &mut Patience(1), (0.0, 1e6), &y, &Options::default()).unwrap();
    assert_eq!(end.end, End::Cancelled { t: 0.0 });
}

#[test]
fn empty_and_tiny_intervals_work() {
    let times = [2.0, 2.0];
    let options =
        Options { output: Output::At(&times), events: &[Crossing::Either], ..Options::default() };
    let end = run(BOTH[1], &mut smooth(oscillate), (2.0, 2.0), &[1.0, 3.0], &options).unwrap();
    assert_eq!((end.end, end.t, &end.y[..]), (End::Reached, 2.0, &[1.0, 3.0][..]));
    assert_eq!(end.samples, [1.0, 3.0, 1.0, 3.0]);
    assert_eq!(end.statistics, Statistics::default());
    // One spacing of t takes one step.
    let next = 2.0 + 2.0 * f64::EPSILON;
    let end = run(BOTH[1], &mut smooth(oscillate), (2.0, next), &[1.0, 3.0], &options).unwrap();
    assert_eq!((end.end, end.t, end.statistics.steps), (End::Reached, next, 1));
}

#[test]
fn step_widths_can_be_limited() {
    let options = Options { max_step: 0.01, first_step: Some(0.004), ..Options::default() };
    let end = run(BOTH[1], &mut smooth(oscillate), (0.0, 1.0), &[1.0, 0.0], &options).unwrap();
    let s = end.statistics;
    assert_eq!((s.smallest, s.rejected), (Some(0.004), 0));
    assert!((s.largest.unwrap() - 0.01).abs() < 1e-4);
}

#[test]
fn invalid_arguments_are_named() {
    let refused = |(from, to): (f64, f64), y: &[f64], options: &Options| {
        Integrator::new(BOTH[1], 2).run(&mut smooth(oscillate), from, y, to, options).unwrap_err()
    };
    let (span, y, good) = ((0.0, 1.0), [1.0, 0.0], Options::default());
    assert_eq!(refused(span, &[1.0], &good), Error::Dimension { expected: 2, given: 1 });
    assert_eq!(
        refused(span, &y, &Options { absolute: &[1.0; 3], ..good }),
        Error::Dimension { expected: 2, given: 3 }
    );
    let error = refused((0.0, f64::NAN), &y, &good);
    assert!(matches!(error, Error::Span { .. }), "{error}");
    let error = refused((0.0, f64::INFINITY), &y, &good);
    assert!(matches!(error, Error::Span { .. }), "{error}");
    let error = refused(span, &[0.0, f64::NAN], &good);
    assert!(matches!(error, Error::InitialState { component: 1, .. }), "{error}");
    for relative in [-1e-3, f64::NAN, 1e-16, 1.0] {
        let error = refused(span, &y, &Options { relative: &[relative], ..good });
        assert!(matches!(error, Error::Tolerance { component: 0, .. }), "{error}");
    }
    let none = Options { relative: &[1e-3, 0.0], absolute: &[1.0, 0.0], ..good };
    let error = refused(span, &y, &none);
    assert!(matches!(error, Error::Tolerance { component: 1, .. }), "{error}");
    let error = refused(span, &y, &Options { absolute: &[1.0, -1.0], ..good });
    assert!(matches!(error, Error::Tolerance { component: 1, .. }), "{error}");
    for width in [0.0, -1.0, f64::NAN] {
        let error = refused(span, &y, &Options { max_step: width, ..good });
        assert!(matches!(error, Error::StepWidth { .. }), "{error}");
        let error = refused(span, &y, &Options { first_step: Some(width), ..good });
        assert!(matches!(error, Error::StepWidth { .. }), "{error}");
    }
    assert_eq!(
        refused(span, &y, &Options { breaks: &[0.0, 2.0, 1.0], ..good }),
        Error::Breaks { index: 2 }
    );
    for times in [[0.5, 0.2], [0.5, 1.1], [-0.1, 0.0]] {
        let error = refused(span, &y, &Options { output: Output::At(&times), ..good });
        assert!(matches!(error, Error::OutputTimes { .. }), "{error}");
    }
}
