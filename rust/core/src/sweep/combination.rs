//! Sums, differences, products and quotients of metrics.

use super::course::Course;
use super::metric::{Growth, Metric, Need, Positions};

/// How two numbers are combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operation {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
}

/// A metric, or a number.
pub enum Operand {
    /// A metric.
    Metric(Box<dyn Metric + Send>),
    /// A number.
    Number(f64),
}

/// Two metrics, or a metric and a number: weighted sums are combinations of combinations.
pub struct Combination {
    /// The operation.
    pub operation: Operation,
    /// The first.
    pub left: Operand,
    /// The second.
    pub right: Operand,
}

impl Operand {
    fn needs(&self) -> Vec<Need> {
        match self {
            Self::Metric(metric) => metric.needs(),
            Self::Number(_) => Vec::new(),
        }
    }

    fn value(&self, evaluate: impl Fn(&dyn Metric) -> f64) -> f64 {
        match self {
            Self::Metric(metric) => evaluate(metric.as_ref()),
            Self::Number(number) => *number,
        }
    }
}

impl Combination {
    fn combine(&self, left: f64, right: f64) -> f64 {
        match self.operation {
            Operation::Add => left + right,
            Operation::Subtract => left - right,
            Operation::Multiply => left * right,
            Operation::Divide => left / right,
        }
    }

    fn metrics(&self) -> impl Iterator<Item = &dyn Metric> {
        [&self.left, &self.right].into_iter().filter_map(|operand| match operand {
            Operand::Metric(metric) => Some(metric.as_ref() as &dyn Metric),
            Operand::Number(_) => None,
        })
    }
}

impl Metric for Combination {
    fn needs(&self) -> Vec<Need> {
        [self.left.needs(), self.right.needs()].concat()
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        let count = self.left.needs().len().min(positions.values.len());
        let (left, right) = positions.values.split_at(count);
        let value_of = |operand: &Operand, values| {
            operand.value(|metric| metric.of(&Positions { values, ..*positions }))
        };
        self.combine(value_of(&self.left, left), value_of(&self.right, right))
    }

    /// Rounding preserves the growth: the rounded sum or product of greater numbers is not less.
    fn growth(&self) -> Growth {
        use {Operand as X, Operation as O};
        let scaled = |metric: &dyn Metric, factor: f64| {
            if factor > 0.0 {
                metric.growth()
            } else if factor < 0.0 {
                metric.growth().reversed()
            } else {
                Growth::Either
            }
        };
        match (&self.left, self.operation, &self.right) {
            (X::Metric(metric), O::Add | O::Subtract, X::Number(_))
            | (X::Number(_), O::Add, X::Metric(metric)) => metric.growth(),
            (X::Number(_), O::Subtract, X::Metric(metric)) => metric.growth().reversed(),
            (X::Metric(metric), O::Multiply | O::Divide, X::Number(factor))
            | (X::Number(factor), O::Multiply, X::Metric(metric)) => scaled(metric, *factor),
            (X::Metric(left), O::Add, X::Metric(right)) if left.growth() == right.growth() => {
                left.growth()
            }
            (X::Metric(left), O::Subtract, X::Metric(right))
                if left.growth() == right.growth().reversed() =>
            {
                left.growth()
            }
            _ => Growth::Either,
        }
    }

    fn of_failed(&self) -> f64 {
        let failed_value = |operand: &Operand| operand.value(|metric| metric.of_failed());
        self.combine(failed_value(&self.left), failed_value(&self.right))
    }

    fn asks_return(&self) -> bool {
        self.metrics().any(Metric::asks_return)
    }

    fn effort(&self) -> usize {
        self.metrics().map(Metric::effort).fold(0, usize::saturating_add)
    }

    fn check(&self, course: &Course<'_>) -> Result<(), String> {
        self.metrics().try_for_each(|metric| metric.check(course))
    }
}
