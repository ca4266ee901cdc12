//! What a metric is: one number of a motion.

use crate::batch::outputs::Quantity;

/// A quantity, and which of its derivatives by the driver: 0 is the value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Need {
    /// Of which joint, link or slide.
    pub quantity: Quantity,
    /// Order of the derivative.
    pub order: usize,
}

/// The positions of one design.
#[derive(Debug, Clone, Copy)]
pub struct Positions<'a> {
    /// The driver's coordinate at each, rad or m.
    pub q: &'a [f64],
    /// The design's dimensions, in the order of [`Mechanism::dimensions`](crate::Mechanism::dimensions).
    pub dimensions: &'a [f64],
    /// What the metric [needs](Metric::needs), in that order: position after position, of a point x and
    /// y.
    pub values: &'a [&'a [f64]],
}

/// How a metric's value changes as positions are added.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Growth {
    /// It never grows.
    Falls,
    /// It never falls.
    Rises,
    /// It may do either.
    Either,
}

/// One number of a motion.
pub trait Metric: Sync {
    /// What it reads.
    fn needs(&self) -> Vec<Need>;

    /// The number; NaN where it has no meaning.
    fn of(&self, positions: &Positions<'_>) -> f64;

    /// How it changes as positions are added: a condition on it may drop a design after a few of them.
    fn growth(&self) -> Growth {
        Growth::Either
    }
}

/// The number 1 for every design that moves over all positions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Moves;

impl Metric for Moves {
    fn needs(&self) -> Vec<Need> {
        Vec::new()
    }

    fn of(&self, _: &Positions<'_>) -> f64 {
        1.0
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
    /// Whether a value meets it; NaN does not.
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
