//! What a fit may change: variables, each of which moves one dimension or several that are tied.

/// Dimensions that differ by less than this, in their own unit and relative to them, are the same.
const SAME: f64 = 1e-9;

/// A number that a fit chooses.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// Indices of the dimensions that it moves, each with its change per unit of the variable.
    pub moves: Vec<(usize, f64)>,
    /// Its least and greatest value; infinite where there is none.
    pub bounds: [f64; 2],
}

/// The variables of a fit, and the dimensions that follow from them.
#[derive(Debug)]
pub(super) struct Variables {
    pub each: Vec<Variable>,
    /// The dimensions where all variables are 0.
    base: Vec<f64>,
    /// Dimensions that move, in order.
    pub by: Vec<usize>,
    /// For each variable the places of its dimensions in `by`, with their change.
    columns: Vec<Vec<(usize, f64)>>,
}

impl Variables {
    pub(super) fn new(base: Vec<f64>, each: Vec<Variable>) -> Self {
        let mut by: Vec<usize> =
            each.iter().flat_map(|one| one.moves.iter().map(|&(dimension, _)| dimension)).collect();
        by.sort_unstable();
        by.dedup();
        let place = |dimension: usize| by.iter().position(|&one| one == dimension).unwrap_or(0);
        let columns = each
            .iter()
            .map(|one| {
                one.moves.iter().map(|&(dimension, rate)| (place(dimension), rate)).collect()
            })
            .collect();
        Self { each, base, by, columns }
    }

    pub(super) fn len(&self) -> usize {
        self.each.len()
    }

    /// The dimensions that belong to values of the variables, into one column of a batch of designs.
    pub(super) fn write(
        &self,
        x: &[f64],
        dimensions: &mut [f64],
        (design, designs): (usize, usize),
    ) {
        for (dimension, &base) in self.base.iter().enumerate() {
            dimensions[dimension * designs + design] = base;
        }
        for (one, &value) in self.each.iter().zip(x) {
            for &(dimension, rate) in &one.moves {
                dimensions[dimension * designs + design] += rate * value;
            }
        }
    }

    /// The dimensions that belong to values of the variables.
    pub(super) fn dimensions(&self, x: &[f64]) -> Vec<f64> {
        let mut dimensions = vec![0.0; self.base.len()];
        self.write(x, &mut dimensions, (0, 1));
        dimensions
    }

    /// Derivatives by the variables, from those by the dimensions that move.
    pub(super) fn chain(&self, by_dimensions: &[f64], by_variables: &mut [f64]) {
        for (column, derivative) in self.columns.iter().zip(by_variables) {
            *derivative = column.iter().map(|&(place, rate)| rate * by_dimensions[place]).sum();
        }
    }

    /// The values of the variables that give these dimensions; `None` if no values do.
    pub(super) fn values(&self, dimensions: &[f64]) -> Option<Vec<f64>> {
        let value = |one: &Variable| {
            let &(dimension, rate) = one.moves.first()?;
            Some((dimensions[dimension] - self.base[dimension]) / rate)
        };
        let x: Vec<f64> = self.each.iter().map(value).collect::<Option<_>>()?;
        let is_near = |(a, b): (&f64, &f64)| (a - b).abs() <= SAME * (1.0 + a.abs());
        dimensions.iter().zip(&self.dimensions(&x)).all(is_near).then_some(x)
    }
}
