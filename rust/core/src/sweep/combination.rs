//! Sums, differences, products and quotients of metrics.

use super::course::Course;
use super::metric::{Growth, Metric, Need, Positions, Slopes};

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

impl Operand {
    /// Derivatives by what it reads; none of a number.
    fn slopes(&self, positions: &Positions<'_>) -> Vec<Vec<f64>> {
        match self {
            Self::Metric(metric) => {
                metric.with_slopes().map(|metric| metric.slopes(positions)).unwrap_or_default()
            }
            Self::Number(_) => vec![],
        }
    }

    /// Derivatives by dimensions on which it depends by itself.
    fn by_dimensions(&self, positions: &Positions<'_>) -> Vec<(usize, f64)> {
        match self {
            Self::Metric(metric) => {
                let slopes = metric.with_slopes();
                slopes.map(|metric| metric.by_dimensions(positions)).unwrap_or_default()
            }
            Self::Number(_) => vec![],
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

    /// The derivatives by both sides, where they have these values.
    fn slopes_by_sides(&self, left: f64, right: f64) -> [f64; 2] {
        match self.operation {
            Operation::Add => [1.0, 1.0],
            Operation::Subtract => [1.0, -1.0],
            Operation::Multiply => [right, left],
            Operation::Divide => [1.0 / right, -left / (right * right)],
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

    fn with_slopes(&self) -> Option<&dyn Slopes> {
        self.metrics().all(|metric| metric.with_slopes().is_some()).then_some(self)
    }

    fn effort(&self) -> usize {
        self.metrics().map(Metric::effort).fold(0, usize::saturating_add)
    }

    fn check(&self, course: &Course<'_>) -> Result<(), String> {
        self.metrics().try_for_each(|metric| metric.check(course))
    }
}

impl Slopes for Combination {
    fn slopes(&self, positions: &Positions<'_>) -> Vec<Vec<f64>> {
        let count = self.left.needs().len().min(positions.values.len());
        let (left, right) = positions.values.split_at(count);
        let [left, right] = [(&self.left, left), (&self.right, right)].map(|(operand, values)| {
            let positions = Positions { values, ..*positions };
            let value = operand.value(|metric| metric.of(&positions));
            (value, operand.slopes(&positions))
        });
        let [by_left, by_right] = self.slopes_by_sides(left.0, right.0);
        let scaled = |(slopes, factor): (Vec<Vec<f64>>, f64)| {
            let scale =
                move |slopes: Vec<f64>| slopes.into_iter().map(|slope| factor * slope).collect();
            slopes.into_iter().map(scale).collect::<Vec<Vec<f64>>>()
        };
        [scaled((left.1, by_left)), scaled((right.1, by_right))].concat()
    }

    fn by_dimensions(&self, positions: &Positions<'_>) -> Vec<(usize, f64)> {
        let count = self.left.needs().len().min(positions.values.len());
        let (left, right) = positions.values.split_at(count);
        let [left, right] = [(&self.left, left), (&self.right, right)].map(|(operand, values)| {
            let positions = Positions { values, ..*positions };
            let value = operand.value(|metric| metric.of(&positions));
            (value, operand.by_dimensions(&positions))
        });
        let [by_left, by_right] = self.slopes_by_sides(left.0, right.0);
        let scaled = |(slopes, factor): (Vec<(usize, f64)>, f64)| {
            slopes.into_iter().map(move |(dimension, slope)| (dimension, factor * slope))
        };
        scaled((left.1, by_left)).chain(scaled((right.1, by_right))).collect()
    }
}
