//! Reads the designs of a chunk, dimension by dimension, so that range checks and scales vectorise
//! over the designs.

use std::ops::Range;

use crate::plan::mechanism::Mechanism;

/// The designs of a chunk.
#[derive(Debug, Default)]
pub(crate) struct Designs {
    /// Number of dimensions.
    size: usize,
    /// Dimensions, design after design.
    rows: Vec<f64>,
    scales: Vec<f64>,
    valid: Vec<bool>,
}

/// One design of a chunk.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DesignRow<'a> {
    pub dimensions: &'a [f64],
    /// See [`crate::plan::constants::DesignConstants::scale`].
    pub scale: f64,
    /// Whether all dimensions are in range.
    pub is_valid: bool,
}

impl Designs {
    /// Reads some of `all` designs. `dimensions` holds the first dimension of every design, then the
    /// second of every design, and so on.
    pub(crate) fn read(
        &mut self,
        mechanism: &Mechanism,
        dimensions: &[f64],
        all: usize,
        designs: Range<usize>,
    ) {
        let (size, count) = (mechanism.dimensions().len(), designs.len());
        let column = |index: usize| &dimensions[index * all..][designs.clone()];
        self.size = size;
        self.rows.resize(count * size, 0.0);
        self.valid.clear();
        self.valid.resize(count, true);
        for (index, &[least, most]) in mechanism.dimensions().ranges().iter().enumerate() {
            let values = column(index);
            for (row, &value) in self.rows.chunks_exact_mut(size).zip(values) {
                row[index] = value;
            }
            for (valid, &value) in self.valid.iter_mut().zip(values) {
                *valid &= least <= value && value <= most;
            }
        }
        self.scales.resize(count, 1.0);
        let row = |design: usize| &self.rows[design * size..][..size];
        mechanism.slots.scales(column, row, &mut self.scales);
    }

    /// The design at an index of the chunk.
    pub(crate) fn row(&self, index: usize) -> DesignRow<'_> {
        DesignRow {
            dimensions: &self.rows[index * self.size..][..self.size],
            scale: self.scales[index],
            is_valid: self.valid[index],
        }
    }
}
