//! The periodic motion of a machine, by shooting: the speed at the beginning of a period with which
//! it is the same at the end.

use std::time::Instant;

use super::cycle::{Begin, Passage, Period, period};
use super::equation::Equation;
use super::make::{breaks_of, finish_run};
use super::outcome::{Ending, Run};
use super::outside::Outside;
use super::source::Source;
use super::task::{Along, Occasion, Task, Watch};
use super::unsteady::Unsteady;
use crate::ode::{Crossing, Integrator, Method};

/// Steps toward the periodic motion, at most; it takes some five.
const STEPS: u32 = 60;
/// A step by less than this part is the last: what is left is its square.
const SETTLED: f64 = 1.0e-9;
/// By how much speed² may fall in one step: what is looked for is the first motion below the idle
/// speed, which is the stable one.
const FALL: f64 = 0.7;
/// A speed that is known to no more than this part is not told by the motor: a period's end then
/// depends on its beginning alone.
const KNOWN: f64 = 1.0e-5;
/// Part of the work of a period that may be left over then: motors are given with so many digits.
const BALANCED: f64 = 1.0e-2;
/// Errors of a period, as multiples of the tolerance.
const NOISE: f64 = 100.0;
/// Part of the work of a period that may be lost in them.
const UNKNOWN: f64 = 0.05;
/// Part of the work of a period to which it is in balance.
const BALANCE: f64 = 1.0e-6;
/// At how many places of a period the machine is compared with itself a period on.
const LOOKS: u32 = 5;
/// How far two periods, one after the other, may differ.
const SAME: f64 = 1.0e-7;

/// What is asked for.
#[derive(Debug, Clone, Copy)]
pub struct Search<'a> {
    /// Where the period begins.
    pub q: f64,
    /// Its length, negative if the driver turns backward.
    pub span: f64,
    /// The mean speed (span by time), where motors and loads tell none; else a first guess.
    pub speed: Option<f64>,
    /// The pair of formulas.
    pub method: Method,
    /// Relative tolerance.
    pub relative: f64,
    /// How many steps a period may have.
    pub max_steps: u64,
    /// When it must be over.
    pub deadline: Option<Instant>,
    /// Where functions from outside are not smooth, ascending.
    pub breaks: &'a [f64],
    /// Inertia added to the driver's.
    pub flywheel: f64,
}

/// A periodic motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Steady {
    /// One period, along the coordinate; its events are the extremes of the speed.
    pub run: Run,
    /// What a small change of the energy at the beginning has become at the end: stable below 1.
    pub multiplier: f64,
    /// The constant moment on the driver that was found for the speed; 0 if the motors told it.
    pub moment: f64,
    /// Work of the motors in a period, J.
    pub drive: f64,
    /// Inertia added to the driver's, kg·m².
    pub flywheel: f64,
}

impl Steady {
    /// What a search near it begins with.
    pub(super) fn begin(&self) -> Begin {
        let speed = self.run.moments.speed.first().copied().unwrap_or(f64::NAN);
        Begin { speed2: speed * speed, moment: self.moment, t: 0.0 }
    }
}

type Found<E> = Result<(Begin, Period), Unsteady<E>>;

/// A search and its work space.
pub(super) struct Shooting<'s, 'a, S, O> {
    pub equation: Equation<'a, S, O>,
    pub search: Search<'s>,
    integrator: Option<Integrator>,
    /// Where the period at hand begins, and its breaks.
    from: f64,
    breaks: Vec<f64>,
}

impl<'s, 'a, S: Source, O: Outside> Shooting<'s, 'a, S, O> {
    pub(super) fn new(
        mut equation: Equation<'a, S, O>,
        search: Search<'s>,
    ) -> Result<Self, Unsteady<O::Error>> {
        equation.flywheel = search.flywheel;
        equation.slopes = true;
        let mut own =
            Self { equation, search, integrator: None, from: search.q, breaks: Vec::new() };
        own.begin_at(search.q)?;
        own.compare()?;
        Ok(own)
    }

    /// Refuses a machine that is another one a period on.
    fn compare(&mut self) -> Result<(), Unsteady<O::Error>> {
        let Search { q: from, span, .. } = self.search;
        for part in 0..LOOKS {
            let here = from + span * f64::from(part) / f64::from(LOOKS);
            let q = [here, here + span];
            let inertia = q.map(|q| {
                let is_there = self.equation.find(q) && self.equation.place(&[q]).is_ok();
                if is_there { self.equation.reduced.inertia[0] } else { f64::NAN }
            });
            // Where there is nothing the period will tell.
            if (inertia[1] - inertia[0]).abs() > SAME * inertia[0].abs() {
                return Err(Unsteady::AnotherOne { q, inertia });
            }
        }
        Ok(())
    }

    /// Periods begin here from now on.
    fn begin_at(&mut self, q: f64) -> Result<(), Unsteady<O::Error>> {
        let Search { span, breaks, .. } = self.search;
        let given: Vec<f64> = breaks.iter().map(|at| at + (q - self.search.q)).collect();
        self.from = q;
        self.breaks =
            breaks_of(self.equation.tables, &given, [q, q + span]).map_err(Unsteady::Broken)?;
        Ok(())
    }

    fn pass(&mut self, begin: Begin) -> Result<Passage, Unsteady<O::Error>> {
        let Self { equation, integrator, search, from, breaks } = self;
        period(equation, integrator, search, (*from, breaks), begin)
    }

    /// Finds the periodic motion, from a guess (speed² and moment) if there is one.
    pub(super) fn find(&mut self, guess: Option<Begin>) -> Found<O::Error> {
        let motors = self.equation.motors;
        let idle = motors.iter().find_map(crate::dynamics::Motor::idle_speed);
        let speed = self.search.speed.or(idle).ok_or(Unsteady::NeedsSpeed)?;
        let begin = guess.unwrap_or(Begin { speed2: speed * speed, moment: 0.0, t: 0.0 });
        if motors.is_empty() {
            return self.at_speed(speed, begin);
        }
        let (begin, first) = self.passing(begin)?;
        if first.depends {
            return self.self_found(begin, first);
        }
        let left = self.left_over(begin, &first);
        if left.abs() > BALANCED * first.turnover {
            let motor = first.drive / self.search.span;
            let needed = motor - left / self.search.span;
            return Err(Unsteady::Unbalanced { motor, needed });
        }
        match self.search.speed {
            Some(speed) => self.at_speed(speed, begin),
            None => Err(Unsteady::NeedsSpeed),
        }
    }

    /// Energy that a period gains.
    fn left_over(&mut self, begin: Begin, period: &Period) -> f64 {
        let _ =
            self.equation.begin(self.search.q, &[self.search.span.signum() * begin.speed2.sqrt()]);
        let inertia = match self.equation.place(&[self.search.q]) {
            Ok(()) => self.equation.reduced.inertia[0],
            Err(_) => f64::NAN,
        };
        0.5 * inertia * (period.speed2 - begin.speed2)
    }

    /// The slowest beginning at or above this one, by powers of 4, that goes through the period.
    fn passing(&mut self, mut begin: Begin) -> Found<O::Error> {
        let from = begin.speed2.sqrt();
        let mut stop = self.search.q;
        for _ in 0..STEPS {
            match self.pass(begin)? {
                Passage::Whole(period) => return Ok((begin, period)),
                Passage::Stops { q } => {
                    stop = q;
                    begin.speed2 *= 4.0;
                }
            }
        }
        Err(Unsteady::Stops { q: stop, from })
    }

    /// Where motors or loads depend on the speed: a zero of the gain of speed² over a period,
    /// between a speed at which it falls and one at which it grows, by Newton's steps.
    fn self_found(&mut self, begin: Begin, first: Period) -> Found<O::Error> {
        let from = begin.speed2.sqrt();
        let idle = self.equation.motors.iter().find_map(crate::dynamics::Motor::idle_speed);
        let idle2 = idle.map_or(0.0, |idle| idle * idle);
        let (mut begin, mut period) = (begin, first);
        // Where it falls from on, and where it grows or the machine stops.
        let (mut high, mut low) = (f64::INFINITY, 0.0);
        let (mut grows, mut stop) = (false, None);
        for _ in 0..2 * STEPS {
            let gain = period.speed2 - begin.speed2;
            let slope = period.speed2_by[0] - 1.0;
            let newton = begin.speed2 - gain / slope;
            // What the errors of a period make of it.
            let noise = NOISE * self.search.relative / slope.abs();
            let settled = SETTLED.max(noise) * begin.speed2;
            if slope < 0.0 && (newton - begin.speed2).abs() <= settled {
                if noise > KNOWN.max(10.0 * NOISE * self.search.relative) {
                    return Err(Unsteady::Weak { part: -slope });
                }
                let last = Begin { speed2: newton, ..begin };
                return match self.pass(last)? {
                    Passage::Whole(period) => Ok((last, period)),
                    Passage::Stops { q } => Err(Unsteady::Stops { q, from }),
                };
            }
            // Above the speed without load a motor brakes, if less and less.
            if gain < 0.0 && (slope < 0.0 || begin.speed2 > idle2) {
                high = begin.speed2;
            } else if gain >= 0.0 {
                (low, grows) = (begin.speed2, true);
            } else {
                // It falls, the more so the slower: below the unstable motion.
                low = begin.speed2;
            }
            let between = newton > low && newton < high && slope < 0.0;
            let mut next = match (between, high.is_finite()) {
                (true, _) => newton,
                (false, true) => 0.5 * (low + high),
                (false, false) => 2.0 * begin.speed2,
            };
            next = next.max(FALL * begin.speed2).min(4.0 * begin.speed2);
            loop {
                if high.is_finite() && high - low <= SETTLED * high {
                    return Err(match stop {
                        Some(q) if !grows => Unsteady::Stops { q, from },
                        _ => Unsteady::CannotCarry { from },
                    });
                }
                if !next.is_finite() || next > 1e30 * first.speed2.max(from * from) {
                    return Err(Unsteady::RunsAway { speed: begin.speed2.sqrt() });
                }
                begin.speed2 = next;
                match self.pass(begin)? {
                    Passage::Whole(own) => {
                        period = own;
                        break;
                    }
                    Passage::Stops { q } => {
                        (low, stop) = (next, Some(q));
                        next = if high.is_finite() { 0.5 * (low + high) } else { 2.0 * next };
                    }
                }
            }
        }
        Err(Unsteady::CannotCarry { from })
    }

    /// A motion of this mean speed, and the constant moment that it takes.
    fn at_speed(&mut self, speed: f64, guess: Begin) -> Found<O::Error> {
        let time = self.search.span / speed;
        let first =
            Begin { moment: guess.moment, speed2: guess.speed2.max(speed * speed), ..guess };
        let (mut begin, mut period) = self.passing(first)?;
        if guess.moment == 0.0 {
            // In balance at so great a speed that the machine does not stop.
            begin.moment -= self.left_over(begin, &period) / self.search.span;
            (begin, period) = self.passing(begin)?;
        }
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let gaps = [period.speed2 - begin.speed2, period.time - time];
            let ([a, b], [c, d]) =
                ([period.speed2_by[0] - 1.0, period.speed2_by[1]], period.time_by);
            let determinant = a * d - b * c;
            let by_start = (b * gaps[1] - d * gaps[0]) / determinant;
            let by_moment = (c * gaps[0] - a * gaps[1]) / determinant;
            let mut part = 1.0;
            let step = by_start.abs() / begin.speed2;
            if !step.is_finite() {
                break;
            }
            loop {
                let next = Begin {
                    speed2: begin.speed2 + part * by_start,
                    moment: begin.moment + part * by_moment,
                    ..begin
                };
                // Not to less than a fourth at once: there the machine may stop.
                let is_near = next.speed2 > 0.25 * begin.speed2;
                if is_near && let Passage::Whole(own) = self.pass(next)? {
                    (begin, period) = (next, own);
                    break;
                }
                part *= 0.5;
                if part < 1e-6 {
                    let from = begin.speed2.sqrt();
                    return Err(Unsteady::Stops { q: self.search.q, from });
                }
            }
            // As long as it gets better, but not beyond what rounding lets it.
            if step <= SETTLED && (step >= 0.5 * last || step <= 1e-3 * SETTLED) {
                let met = (period.time - time).abs() <= SETTLED * time.abs()
                    && (period.speed2 - begin.speed2).abs() <= SETTLED * begin.speed2;
                return if met { Ok((begin, period)) } else { Err(Unsteady::NotMet { speed }) };
            }
            last = step;
        }
        Err(Unsteady::NotMet { speed })
    }

    /// The motion found, with all its moments.
    pub(super) fn run(
        mut self,
        begin: Begin,
        period: &Period,
    ) -> Result<Steady, Unsteady<O::Error>> {
        // Once more, a period on: there the machine must be the same.
        let Search { q, span, method, relative, max_steps, deadline, breaks, flywheel, .. } =
            self.search;
        self.begin_at(q + span)?;
        let later = self.pass(Begin { t: begin.t + period.time, ..begin })?;
        let part = SAME.max(NOISE * relative);
        let same = matches!(later, Passage::Whole(own)
            if (own.speed2 - period.speed2).abs() <= part * period.speed2
            && (own.time - period.time).abs() <= part * period.time.abs());
        if !same {
            return Err(Unsteady::NotPeriodic);
        }
        self.equation.extra = begin.moment;
        let watches =
            [Watch { occasion: Occasion::Extreme, crossing: Crossing::Either, stops: false }];
        let task = Task {
            along: Along::Coordinate,
            t: 0.0,
            q: &[q],
            speed: &[span.signum() * begin.speed2.sqrt()],
            end: q + span,
            method,
            relative,
            absolute: None,
            max_step: f64::INFINITY,
            max_steps,
            deadline,
            breaks,
            watches: &watches,
            flywheel,
        };
        self.equation.slopes = false;
        let run = finish_run(self.equation, &task).map_err(|error| match error {
            crate::ode::Error::System(broken) => Unsteady::Broken(broken),
            other => Unsteady::Other(other.to_string()),
        })?;
        match run.ending {
            Ending::Reached => {}
            Ending::Late | Ending::Cancelled => return Err(Unsteady::Cancelled { q }),
            ref other => return Err(Unsteady::Other(format!("the period ended early: {other:?}"))),
        }
        let ends = |list: &[f64]| list.last().zip(list.first()).map_or(f64::NAN, |(b, a)| b - a);
        let stored: Vec<f64> = run.energies.iter().map(|pair| pair[1]).collect();
        let left = ends(&run.moments.work) - ends(&stored);
        // At too great a speed the energy's own rounding is more than a period's work.
        let kinetic = run.energies.first().map_or(f64::NAN, |pair| pair[0]);
        let noise = NOISE * relative * kinetic;
        let idle = period.turnover <= 64.0 * f64::EPSILON * kinetic;
        let balanced = left.abs() <= BALANCE * period.turnover + noise;
        if !(balanced && (idle || noise <= UNKNOWN * period.turnover)) {
            return Err(Unsteady::RunsAway { speed: begin.speed2.sqrt() });
        }
        let multiplier = period.speed2_by[0];
        Ok(Steady { run, multiplier, moment: begin.moment, drive: period.drive, flywheel })
    }
}
