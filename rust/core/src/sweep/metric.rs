//! A metric: one number of a motion.

use super::course::Course;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::batch::request::Quantity;

/// A quantity, and the order of its derivative by the driver: 0 is the value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Need {
    /// The joint, link or slide.
    pub quantity: Quantity,
    /// Order of the derivative.
    pub order: usize,
}

impl Need {
    /// Numbers per position, of a value or with one driver.
    pub(super) fn width(self) -> usize {
        match self.quantity {
            Quantity::Joint(_) | Quantity::Origin(_) | Quantity::Direction(_) => 2,
            Quantity::Slide(_) | Quantity::Angle(_) => 1,
        }
    }
}

/// Of what a metric is the mean over the positions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MeanOf {
    /// Where it is read.
    pub need: Need,
    /// For a joint, 0 for x and 1 for y.
    pub component: usize,
    /// Whether the metric is the root of the mean of its squares.
    pub is_root_of_squares: bool,
}

/// The positions of one design.
#[derive(Debug, Clone, Copy)]
pub struct Positions<'a> {
    /// The coordinates, rad or m: those of all drivers for each position.
    pub q: &'a [f64],
    /// Number of drivers.
    pub drivers: usize,
    /// The design's dimensions, in the order of [`Mechanism::dimensions`](crate::Mechanism::dimensions).
    pub dimensions: &'a [f64],
    /// The quantities that the metric [needs](Metric::needs), in that order: position after position, x and y
    /// for a point.
    pub values: &'a [&'a [f64]],
    /// Whether the quantities that the metric needs are the same at the end of the turn as at its start,
    /// so that the first position follows the last: after a change point, and in higher classes, this may
    /// take two turns. Known only to metrics that [ask](Metric::asks_return).
    pub returns: bool,
    /// See [`Self::is_cancelled`].
    pub(super) cancel: Option<&'a AtomicBool>,
}

impl Positions<'_> {
    /// Whether the caller has cancelled the work: then the metric may return any number. A metric that takes
    /// long for many positions checks this now and then.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// Number of positions.
    #[must_use]
    pub fn count(&self) -> usize {
        self.q.len() / self.drivers.max(1)
    }
}

/// How a metric's value changes as positions are added.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Growth {
    /// It never grows.
    Falls,
    /// It never falls.
    Rises,
    /// It may grow and fall.
    Either,
}

impl Growth {
    /// The growth of the negative.
    #[must_use]
    pub fn reversed(self) -> Self {
        match self {
            Self::Falls => Self::Rises,
            Self::Rises => Self::Falls,
            Self::Either => Self::Either,
        }
    }
}

/// One number of a motion.
///
/// ```
/// use assur::sweep::{Coordinate, Metric, Need, Positions, Sweep};
/// use assur::{Control, FourBar, FourBarMode, Mechanism};
///
/// /// How often a coordinate passes through zero.
/// struct Zeros(Coordinate);
///
/// impl Metric for Zeros {
///     fn needs(&self) -> Vec<Need> {
///         vec![self.0.need]
///     }
///
///     fn of(&self, positions: &Positions<'_>) -> f64 {
///         let values = positions.values[0];
///         values.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count() as f64
///     }
/// }
///
/// let four_bar = Mechanism::new(&FourBar::description(FourBarMode::Open))?;
/// let q: Vec<f64> = (0..72).map(|k| f64::from(k) * std::f64::consts::TAU / 72.0).collect();
/// // The rocker stands still, for a moment, at both ends of its swing.
/// let zeros = Zeros(Coordinate::link(four_bar.link("rocker")?).derivative(1));
/// let sweep = Sweep { metrics: &[&zeros], ..Sweep::of(&four_bar, four_bar.drawing(), &q) };
/// assert_eq!(four_bar.measure(&sweep, &Control::default())?.values, [[2.0]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Metric: Sync {
    /// The quantities that it reads.
    fn needs(&self) -> Vec<Need>;

    /// The number; NaN where it has no meaning.
    fn of(&self, positions: &Positions<'_>) -> f64;

    /// How it changes as positions are added: a condition on it may drop a design after a few of them.
    /// It holds to the last bit: a sum that rounding may lower does not only rise.
    fn growth(&self) -> Growth {
        Growth::Either
    }

    /// The number of a design that does not move over all positions.
    fn of_failed(&self) -> f64 {
        f64::NAN
    }

    /// Whether it needs to know if the motion [returns](Positions::returns): two more positions are solved. A
    /// metric that depends on the order of positions needs it: otherwise a [part](super::Part) may leave gaps
    /// between those that it gets.
    fn asks_return(&self) -> bool {
        false
    }

    /// About how many positions can be solved in the time that it takes for one: a caller checks for signals
    /// during calls that take long.
    fn effort(&self) -> usize {
        0
    }

    /// Of what it is the mean, if it is one: then it has a gradient.
    fn mean_of(&self) -> Option<MeanOf> {
        None
    }

    /// Its derivatives by what it reads, if it knows them: then it has a gradient, too.
    fn with_slopes(&self) -> Option<&dyn Slopes> {
        None
    }

    /// Checks that it has a meaning for a mechanism at the coordinates of `course`.
    ///
    /// # Errors
    ///
    /// The reason why it has no meaning. By default, derivatives are for one driver.
    fn check(&self, course: &Course<'_>) -> Result<(), String> {
        if course.drivers > 1 && self.needs().iter().any(|need| need.order > 0) {
            return Err(format!("derivatives need one driver, here are {}", course.drivers));
        }
        Ok(())
    }
}

/// A metric that knows its derivatives by the numbers that it reads.
pub trait Slopes: Metric {
    /// For each [need](Metric::needs) the derivatives at all positions, as many as there are numbers; of a direction
    /// one a position, by its angle. NaN where it has none.
    fn slopes(&self, positions: &Positions<'_>) -> Vec<Vec<f64>>;

    /// Derivatives by dimensions on which it depends by itself: their indices and these.
    fn by_dimensions(&self, _: &Positions<'_>) -> Vec<(usize, f64)> {
        vec![]
    }
}

impl<M: Metric + ?Sized + Send> Metric for Box<M> {
    fn needs(&self) -> Vec<Need> {
        self.as_ref().needs()
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        self.as_ref().of(positions)
    }

    fn growth(&self) -> Growth {
        self.as_ref().growth()
    }

    fn of_failed(&self) -> f64 {
        self.as_ref().of_failed()
    }

    fn asks_return(&self) -> bool {
        self.as_ref().asks_return()
    }

    fn effort(&self) -> usize {
        self.as_ref().effort()
    }

    fn mean_of(&self) -> Option<MeanOf> {
        self.as_ref().mean_of()
    }

    fn with_slopes(&self) -> Option<&dyn Slopes> {
        self.as_ref().with_slopes()
    }

    fn check(&self, course: &Course<'_>) -> Result<(), String> {
        self.as_ref().check(course)
    }
}

/// The number 1 for every design that moves over all positions, and 0 for all others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Moves;

impl Metric for Moves {
    fn needs(&self) -> Vec<Need> {
        Vec::new()
    }

    fn of(&self, _: &Positions<'_>) -> f64 {
        1.0
    }

    fn of_failed(&self) -> f64 {
        0.0
    }
}

/// How a metric compares with a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Relation {
    /// `<`
    Less,
    /// `<=`
    AtMost,
    /// `>`
    Greater,
    /// `>=`
    AtLeast,
}

/// A design for which this is false is dropped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Condition {
    /// Index among the metrics.
    pub metric: usize,
    /// How the metric compares with the limit.
    pub relation: Relation,
    /// The limit.
    pub limit: f64,
}

impl Condition {
    /// Whether a value meets the condition; NaN does not.
    #[must_use]
    pub fn holds(&self, value: f64) -> bool {
        match self.relation {
            Relation::Less => value < self.limit,
            Relation::AtMost => value <= self.limit,
            Relation::Greater => value > self.limit,
            Relation::AtLeast => value >= self.limit,
        }
    }

    /// Whether it stays false as positions are added, given that it is false.
    pub(super) fn stays_false(&self, growth: Growth) -> bool {
        match self.relation {
            Relation::Less | Relation::AtMost => growth == Growth::Rises,
            Relation::Greater | Relation::AtLeast => growth == Growth::Falls,
        }
    }
}
