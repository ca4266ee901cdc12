//! Nonsmooth right-hand sides: tables over t and over the state.

use super::*;

const KNOTS: [f64; 5] = [0.0, 0.7, 1.1, 2.0, 3.0];
const VALUES: [f64; 5] = [1.0, -2.0, 3.0, 0.5, -1.0];

fn piece_value(piece: usize, x: f64) -> f64 {
    let (a, b) = (KNOTS[piece], KNOTS[piece + 1]);
    VALUES[piece] + (VALUES[piece + 1] - VALUES[piece]) * (x - a) / (b - a)
}

/// The piece that contains x; the first and last extend to infinity.
fn piece_of(x: f64) -> usize {
    KNOTS[1..4].iter().filter(|knot| **knot <= x).count()
}

/// ∫ of the table from 0.
fn table_integral(x: f64) -> f64 {
    let piece = piece_of(x);
    let full = |p: usize| 0.5 * (VALUES[p] + VALUES[p + 1]) * (KNOTS[p + 1] - KNOTS[p]);
    let begin = KNOTS[piece];
    let last = 0.5 * (VALUES[piece] + piece_value(piece, x)) * (x - begin);
    (0..piece).map(full).sum::<f64>() + last
}

/// y' = −y·table(t), where the table also jumps by 1 at t = 2.5.
struct OverTime {
    piece: Option<(usize, f64)>,
    intervals: usize,
}

const JUMP: f64 = 2.5;

impl System for OverTime {
    type Error = Infallible;

    fn rates(&mut self, t: f64, y: &[f64], rates: &mut [f64]) -> Result<(), Fault<Infallible>> {
        let (piece, jump) = self.piece.unwrap_or((piece_of(t), f64::from(u8::from(t > JUMP))));
        rates[0] = -y[0] * (piece_value(piece, t) + jump);
        Ok(())
    }

    fn begin_interval(&mut self, from: f64, to: f64, _: &[f64]) -> Result<(), Infallible> {
        let middle = 0.5 * (from + to);
        let jump = f64::from(u8::from(middle > JUMP));
        self.piece = self.piece.map(|_| (piece_of(middle), jump));
        self.intervals += 1;
        Ok(())
    }
}

#[test]
fn breaks_keep_the_tolerance_and_cost_less() {
    let breaks = [0.0, 0.7, 1.1, 2.0, JUMP, 3.0];
    let integral = |t: f64| table_integral(t) + (t - JUMP).max(0.0);
    for method in BOTH {
        for (from, to) in [(0.0, 3.0), (3.0, 0.0), (0.2, 2.8)] {
            let exact = (integral(from) - integral(to)).exp();
            let run = |breaks: &[f64], piece| {
                let mut system = OverTime { piece, intervals: 0 };
                let options = Options { breaks, ..Options::default() };
                let run = Integrator::new(method, 1)
                    .run(&mut system, from, &[1.0], to, &options)
                    .unwrap();
                assert_eq!(run.end, End::Reached);
                assert_eq!(system.intervals as u64, run.statistics.restarts + 1);
                ((run.y[0] / exact - 1.0).abs(), run.statistics)
            };
            let (with, cost_with) = run(&breaks, Some((0, 0.0)));
            let (without, cost_without) = run(&[], None);
            println!("{method:?}: {with:.1e} {without:.1e}, {cost_with:?} {cost_without:?}");
            assert!(with < 1e-10 && without > 3.0 * with, "{with:e} {without:e}");
            assert_eq!(cost_with.restarts, 4);
            assert!(cost_with.evaluations * 3 < cost_without.evaluations * 2);
        }
    }
}

/// No sliver is left before a break.
#[test]
fn the_last_steps_of_a_smooth_interval_are_equal() {
    let options = Options {
        breaks: &[1.0],
        first_step: Some(0.3),
        max_step: 0.3,
        output: Output::Dense,
        ..Options::default()
    };
    let run = Integrator::new(Method::DormandPrince853, 1)
        .run(&mut smooth(|t, _, r| r[0] = t), 0.0, &[0.0], 1.4, &options)
        .unwrap();
    let ends = [0.25, 0.5, 0.75, 1.0, 1.2, 1.4];
    assert_eq!(run.dense.ends().len(), ends.len());
    assert!(largest_difference(run.dense.ends(), &ends) < 1e-15, "{:?}", run.dense.ends());
}

/// Breaks closer than any step, at the ends, repeated, and outside the interval.
#[test]
fn unusual_breaks_do_no_harm() {
    let near = 1.0 + 2.0 * f64::EPSILON;
    let breaks = [-1.0, 0.0, 0.5, 0.5, 1.0, near, 2.0, 5.0];
    for (from, to) in [(0.0, 2.0), (2.0, 0.0)] {
        let options = Options { breaks: &breaks, ..Options::default() };
        let run = Integrator::new(Method::DormandPrince853, 1)
            .run(&mut smooth(|t, _, r| r[0] = 2.0 * t), from, &[from * from], to, &options)
            .unwrap();
        assert_eq!(run.end, End::Reached);
        assert_eq!(run.statistics.restarts, 3);
        assert!((run.y[0] - to * to).abs() < 1e-14);
    }
}

/// q'' = table(q): a particle in a potential −∫table. The system keeps its piece and changes it by
/// an event at each knot.
struct OverState {
    piece: usize,
    snaps: bool,
    follows: bool,
}

impl System for OverState {
    type Error = Infallible;

    fn rates(&mut self, _: f64, y: &[f64], rates: &mut [f64]) -> Result<(), Fault<Infallible>> {
        rates[0] = y[1];
        let piece = if self.follows { self.piece } else { piece_of(y[0]) };
        rates[1] = piece_value(piece, y[0]);
        Ok(())
    }

    fn events(&mut self, _: f64, y: &[f64], values: &mut [f64]) -> Result<(), Infallible> {
        let last = self.piece + 2 == KNOTS.len();
        values[0] = if self.piece == 0 { f64::NAN } else { y[0] - KNOTS[self.piece] };
        values[1] = if last { f64::NAN } else { KNOTS[self.piece + 1] - y[0] };
        Ok(())
    }

    fn on_event(&mut self, event: usize, _: f64, y: &mut [f64]) -> Result<Action, Infallible> {
        let knot = self.piece + event;
        self.piece = if event == 0 { self.piece - 1 } else { self.piece + 1 };
        if self.snaps {
            y[0] = KNOTS[knot];
        }
        Ok(Action::Restart)
    }
}

const PIECE: [Crossing; 2] = [Crossing::Boundary; 2];

fn energy(y: &[f64]) -> f64 {
    0.5 * y[1] * y[1] - table_integral(y[0])
}

#[test]
fn tables_over_the_state_keep_the_tolerance() {
    // Between two walls of the potential: over all knots and back, many times.
    for method in BOTH {
        for snaps in [true, false] {
            let start = [1.3, 1.7];
            let mut errors = vec![];
            for follows in [true, false] {
                let mut system = OverState { piece: piece_of(start[0]), snaps, follows };
                let events = if follows { &PIECE[..] } else { &[] };
                let (relative, absolute) = (&[1e-11][..], &[1e-11][..]);
                let options = Options { relative, absolute, events, ..Options::default() };
                let run = Integrator::new(method, 2)
                    .run(&mut system, 0.0, &start, 40.0, &options)
                    .unwrap();
                assert_eq!(run.end, End::Reached);
                if follows {
                    assert!(run.events.len() > 30, "{}", run.events.len());
                    assert_eq!(system.piece, piece_of(run.y[0]));
                    assert_eq!(run.events.len() as u64, run.statistics.restarts);
                }
                errors.push((energy(&run.y) - energy(&start)).abs());
                println!(
                    "{method:?} follows {follows}: {:.1e}, {} events, {:?}",
                    errors.last().unwrap(),
                    run.events.len(),
                    run.statistics
                );
            }
            assert!(errors[0] < 2e-9, "{method:?}: {errors:?}");
        }
    }
}

/// A knot reached exactly or nearly at rest, uphill from the left or from the right.
#[test]
fn a_run_may_reach_a_knot_at_rest() {
    for off in [0.0, 1e-17, -1e-17, 1e-13, -1e-13, 1e-7, -1e-7, 1e-3] {
        for method in BOTH {
            for (from, knot, direction) in [(0.5, KNOTS[1], 1.0), (1.5, KNOTS[2], -1.0)] {
                for snaps in [true, false] {
                    let climb = table_integral(from) - table_integral(knot);
                    let start = [from, direction * ((2.0 * climb).sqrt() + off)];
                    let mut system = OverState { piece: piece_of(from), snaps, follows: true };
                    let options = Options { events: &PIECE, max_steps: 2000, ..Options::default() };
                    let run = Integrator::new(method, 2)
                        .run(&mut system, 0.0, &start, 1.4, &options)
                        .unwrap();
                    assert_eq!(run.end, End::Reached);
                    assert_eq!(system.piece, piece_of(run.y[0]), "{:?}", run.events);
                    let change = (energy(&run.y) - energy(&start)).abs();
                    assert!(change < 1e-9, "{method:?} {off:e} {from}: {change:e}");
                    assert!(off < 1e-10 || run.events.len() >= 2, "{:?}", run.events);
                }
            }
        }
    }
}

/// A start on a knot that moves into a piece other than the assumed one.
#[test]
fn a_wrong_piece_at_the_start_is_left_at_once() {
    for (piece, speed) in [(1, -1.0), (2, -1.0), (0, 1.0), (1, 1.0), (3, 1.0)] {
        let mut system = OverState { piece, snaps: false, follows: true };
        let start = [KNOTS[1], speed];
        let options = Options { events: &PIECE, ..Options::default() };
        let run = Integrator::new(Method::DormandPrince853, 2)
            .run(&mut system, 0.0, &start, 0.1, &options)
            .unwrap();
        assert_eq!(system.piece, piece_of(run.y[0]));
        let change = (energy(&run.y) - energy(&start)).abs();
        assert!(change < 1e-10, "piece {piece}, speed {speed}: {change:e}");
    }
}

/// Both sides push towards the boundary: no solution continues, and the run reports it.
#[test]
fn sliding_along_a_boundary_stalls() {
    struct Sliding(f64);
    impl System for Sliding {
        type Error = Infallible;
        fn rates(&mut self, _: f64, _: &[f64], r: &mut [f64]) -> Result<(), Fault<Infallible>> {
            r[0] = -self.0;
            Ok(())
        }
        fn events(&mut self, _: f64, y: &[f64], values: &mut [f64]) -> Result<(), Infallible> {
            values[0] = self.0 * y[0];
            Ok(())
        }
        fn on_event(&mut self, _: usize, _: f64, _: &mut [f64]) -> Result<Action, Infallible> {
            self.0 = -self.0;
            Ok(Action::Restart)
        }
    }
    let options =
        Options { events: &[Crossing::Boundary], max_steps: 10_000, ..Options::default() };
    let run = Integrator::new(Method::DormandPrince853, 1)
        .run(&mut Sliding(1.0), 0.0, &[0.5], 1.0, &options)
        .unwrap();
    assert!(matches!(run.end, End::Stalled { t } if (t - 0.5).abs() < 1e-12), "{}", run.end);
    assert!(run.statistics.steps < 200, "{:?}", run.statistics);
}
