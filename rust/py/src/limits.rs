//! Limits of designs for Python.

use std::sync::atomic::AtomicBool;

use assur::{Limits, LimitsFinder, SolveError, Tables};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::parallel_map::parallel_map;

/// Designs of a chunk, which share work space.
const CHUNK: usize = 256;

/// Limits of all designs: intervals (designs × count × 2, filled with NaN), the parts that fold at their ends
/// (−1: none), and turns until the motion closes (NaN: it does not).
#[derive(IntoPyObject)]
pub(crate) struct FoundLimits<'py> {
    count: usize,
    intervals: Bound<'py, PyArray1<f64>>,
    folds: Bound<'py, PyArray1<i32>>,
    period: Bound<'py, PyArray1<f64>>,
    names: Vec<String>,
}

/// Finds the limits of designs; `dimensions`: the first one of every design, then the second.
pub(crate) fn find(
    mechanism: &assur::Mechanism,
    dimensions: &[f64],
    signs: &[i8],
    threads: Option<usize>,
    cancel: &AtomicBool,
) -> Result<Vec<Limits>, SolveError> {
    let designs = dimensions.len().checked_div(mechanism.dimensions().len()).unwrap_or(1);
    let chunk = |index: usize| -> Result<Vec<Limits>, SolveError> {
        let tables = Tables::default();
        let mut finder = LimitsFinder::new(mechanism, signs, &tables, Some(cancel))?;
        let chunk = index * CHUNK..((index + 1) * CHUNK).min(designs);
        let mut values = vec![0.0; mechanism.dimensions().len()];
        let mut limits = Vec::with_capacity(chunk.len());
        for design in chunk {
            for (value, column) in values.iter_mut().zip(dimensions.chunks_exact(designs.max(1))) {
                *value = column[design];
            }
            limits.push(finder.limits(&values)?);
        }
        Ok(limits)
    };
    let chunks = parallel_map(designs.div_ceil(CHUNK), 4, threads, cancel, &chunk);
    let limits: Result<Vec<Vec<Limits>>, SolveError> = chunks.into_iter().collect();
    Ok(limits?.into_iter().flatten().collect())
}

/// As arrays.
pub(crate) fn arrays<'py>(
    py: Python<'py>,
    limits: &[Limits],
    names: Vec<String>,
) -> FoundLimits<'py> {
    let count = limits.iter().map(|limits| limits.intervals.len()).max().unwrap_or(0);
    let (mut intervals, mut folds) = (Vec::new(), Vec::new());
    for design_limits in limits {
        for interval in &design_limits.intervals {
            intervals.extend(interval.ends);
            let index = |fold: Option<usize>| fold.and_then(|fold| i32::try_from(fold).ok());
            folds.extend(interval.folds.map(|fold| index(fold).unwrap_or(-1)));
        }
        for _ in design_limits.intervals.len()..count {
            intervals.extend([f64::NAN; 2]);
            folds.extend([-1; 2]);
        }
    }
    let period = limits.iter().map(|limits| limits.period.map_or(f64::NAN, f64::from)).collect();
    FoundLimits {
        count,
        intervals: PyArray1::from_vec(py, intervals),
        folds: PyArray1::from_vec(py, folds),
        period: PyArray1::from_vec(py, period),
        names,
    }
}
