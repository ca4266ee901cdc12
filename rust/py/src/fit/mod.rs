//! Fits of a mechanism's dimensions, for Python.

mod words;

use std::num::NonZeroUsize;
use std::sync::{Mutex, MutexGuard};

use assur::{
    FitCondition, FitRequest, FitTarget, Fitted, Freedom, Quantity, Simd, TargetNumber, Timing,
    Travel, Variable,
};
use pyo3::prelude::*;

use crate::convert::metric::metric_of;
use crate::convert::word::Word;
use crate::mechanism::Mechanism;
use crate::{detach, error, error_map};
use words::{AimWord, When, Where};

/// Dimensions with their changes per unit; least and greatest value.
type VariableParts = (Vec<(usize, f64)>, (f64, f64));
/// What is read (kind and name), the component, its weight, what it is to be, whether whole turns do not matter.
type NumberParts = (Word<Where>, String, usize, f64, Vec<f64>, bool);
/// Numbers, weights of the positions, when, coordinates, whether the path is closed, what is free.
type TargetParts = (Vec<NumberParts>, Vec<f64>, Word<When>, Vec<f64>, bool, Word<Freedom>);
/// A metric, what it is to be, what counts as a miss of 1.
type ConditionParts<'py> = (Bound<'py, PyAny>, Word<AimWord>, f64, f64);
/// Dimensions, index of the assembly, coordinates, numbers of targets, sum of squares, misses of limits.
type Design = (Vec<f64>, usize, Vec<f64>, Vec<f64>, f64, Vec<f64>);

/// A fit in progress. What a signal interrupts goes on with the next call.
#[pyclass(frozen, module = "assur._core")]
pub(crate) struct Fit {
    mechanism: Py<Mechanism>,
    inner: Mutex<assur::Fit>,
}

#[pymethods]
impl Fit {
    #[new]
    #[allow(clippy::too_many_arguments, reason = "each is a part of the request")]
    fn new(
        py: Python<'_>,
        mechanism: Py<Mechanism>,
        base: Vec<f64>,
        variables: Vec<VariableParts>,
        targets: Vec<TargetParts>,
        conditions: Vec<ConditionParts<'_>>,
        assemblies: Vec<Vec<i8>>,
        whole_turn: bool,
        seed: u64,
        threads: Option<NonZeroUsize>,
    ) -> PyResult<Self> {
        let inner = &mechanism.bind(py).get().inner;
        let variable =
            |(moves, (low, high)): VariableParts| Variable { moves, bounds: [low, high] };
        let condition = |(metric, aim, value, unit): ConditionParts<'_>| -> PyResult<FitCondition> {
            let own = metric_of(inner, &metric)?;
            if own.with_slopes().is_none() {
                let repr = metric.repr()?;
                let message = format!("{repr} has no gradient: fit cannot aim at it");
                return Err(error::input(&message, None));
            }
            Ok(FitCondition { metric: own, aim: aim.0.of(value), unit })
        };
        let request = FitRequest {
            base,
            variables: variables.into_iter().map(variable).collect(),
            targets: targets
                .into_iter()
                .map(|parts| target(inner, parts))
                .collect::<PyResult<_>>()?,
            conditions: conditions.into_iter().map(condition).collect::<PyResult<_>>()?,
            assemblies,
            travel: if whole_turn { Travel::WholeTurn } else { Travel::Between },
            seed,
            threads,
            simd: Simd::allowed(),
        };
        let fit = detach::catch_panic(|| Ok(assur::Fit::new(request)))?;
        Ok(Self { mechanism, inner: Mutex::new(fit) })
    }

    /// A round of starts, the best of which descend.
    fn round(&self, py: Python<'_>) -> PyResult<()> {
        let mechanism = &self.mechanism.bind(py).get().inner;
        detach::run(py, false, |cancel| {
            self.lock()?.round(mechanism, cancel).map_err(error_map::solve)
        })?
    }

    /// The designs found so far, best first; of those that miss a limit the one that misses it the least.
    fn found(&self, py: Python<'_>) -> PyResult<(Vec<Design>, Option<Design>)> {
        let mechanism = &self.mechanism.bind(py).get().inner;
        let fit = self.lock()?;
        let found = fit.found(mechanism).into_iter().map(parts).collect();
        Ok((found, fit.nearest(mechanism).map(parts)))
    }

    /// The least root of a sum of squared residuals so far; infinite without designs.
    fn best(&self) -> PyResult<f64> {
        Ok(self.lock()?.best().sqrt())
    }

    /// Designs that were evaluated so far.
    #[getter]
    fn evaluations(&self) -> PyResult<u64> {
        Ok(self.lock()?.evaluations())
    }

    /// Whether the best design misses nothing but rounding, or was found so often.
    fn is_settled(&self, agreeing: u64) -> PyResult<bool> {
        let fit = self.lock()?;
        Ok(fit.is_exact() || fit.agreeing() >= agreeing)
    }
}

impl Fit {
    fn lock(&self) -> PyResult<MutexGuard<'_, assur::Fit>> {
        self.inner.lock().map_err(|_| error::internal("a fit was left in disorder", "fit"))
    }
}

fn target(mechanism: &assur::Mechanism, parts: TargetParts) -> PyResult<FitTarget> {
    let (numbers, weights, when, q, is_closed, freedom) = parts;
    let number = |(place, name, axis, weight, wanted, is_angle): NumberParts| {
        let quantity = place.0.named(mechanism, &name).map_err(error_map::solve)?;
        Ok(TargetNumber { quantity, axis, weight, wanted, is_angle })
    };
    Ok(FitTarget {
        numbers: numbers.into_iter().map(number).collect::<PyResult<_>>()?,
        weights,
        timing: match when.0 {
            When::Fixed => Timing::Fixed(q),
            When::Phase => Timing::Phase(q),
            When::Ordered => Timing::Free { is_ordered: true, is_closed },
            When::Free => Timing::Free { is_ordered: false, is_closed },
        },
        freedom: freedom.0,
    })
}

fn parts(design: Fitted) -> Design {
    let Fitted { dimensions, assembly, q, free, sum, misses } = design;
    (dimensions, assembly, q, free, sum, misses)
}

impl Where {
    fn named(
        self,
        mechanism: &assur::Mechanism,
        name: &str,
    ) -> Result<Quantity, assur::SolveError> {
        Ok(match self {
            Self::Joint => Quantity::Joint(mechanism.joint(name)?),
            Self::Angle => Quantity::Angle(mechanism.link(name)?),
            Self::Origin => Quantity::Origin(mechanism.link(name)?),
            Self::Slide => Quantity::Slide(mechanism.slide(name)?),
        })
    }
}
