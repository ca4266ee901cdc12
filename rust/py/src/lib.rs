//! Python binding of `assur`: converts, releases the GIL, maps errors; nothing else.
#![allow(clippy::needless_pass_by_value, reason = "PyO3 hands arguments over by value")]

mod error;
mod gate;
mod mechanism;
mod metrics;
mod trig;

use pyo3::prelude::*;

/// The extension module behind the Python package.
#[pymodule]
mod _core {
    #[pymodule_export]
    use super::mechanism::Mechanism;
    #[pymodule_export]
    use super::metrics::{acute, curvature, instant_centre};
    use super::pyfunction;
    #[pymodule_export]
    use super::trig::{asin, atan2, sin_cos};

    /// The version of the compiled core.
    #[pyfunction]
    fn version() -> &'static str {
        assur::VERSION
    }
}
