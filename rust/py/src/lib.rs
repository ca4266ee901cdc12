//! Python binding of `assur`: converts arguments, releases the GIL and maps errors.
#![allow(clippy::needless_pass_by_value, reason = "PyO3 hands arguments over by value")]

mod assemblies;
mod convert;
mod detach;
mod equations;
mod equilibria;
mod error;
mod error_map;
mod fit;
mod flywheel;
mod inverse;
mod limits;
mod machine;
mod mechanism;
mod memory;
mod metrics;
mod motion;
mod named;
mod papers;
mod parallel_map;
mod reactions;
mod reduce;
mod remedies;
mod reserve;
mod run;
mod search;
mod spline;
mod sweep;
#[cfg(feature = "test-hooks")]
mod test_hooks;
mod trig;

use pyo3::prelude::*;

/// The extension module behind the Python package.
#[pymodule]
mod _core {
    #[pymodule_export]
    use super::convert::target::{refusal_of_path, refusal_of_poses};
    #[pymodule_export]
    use super::convert::value::table_values;
    #[pymodule_export]
    use super::error_map::error_kinds;
    #[pymodule_export]
    use super::fit::Fit;
    #[pymodule_export]
    use super::flywheel::Flywheels;
    #[pymodule_export]
    use super::inverse::Inverse;
    #[pymodule_export]
    use super::machine::Machine;
    #[pymodule_export]
    use super::mechanism::Mechanism;
    #[pymodule_export]
    use super::metrics::{acute, curvature, instant_centre};
    #[pymodule_export]
    use super::motion::solve::KnownSigns;
    #[pymodule_export]
    use super::named::{class_iv_drawing, four_bar_drawing, slider_crank_drawing};
    #[pymodule_export]
    use super::papers::crank_rocker::{
        crank_rocker_blocked, crank_rocker_exact_least_gamma, crank_rocker_extremes,
        crank_rocker_grashof, crank_rocker_ground_range, crank_rocker_least_gamma,
        crank_rocker_run, crank_rocker_solve, crank_rocker_turns,
    };
    #[pymodule_export]
    use super::papers::slider_crank::{
        slider_crank_deviation, slider_crank_fourier, slider_crank_fraction,
        slider_crank_greatest_acceleration, slider_crank_greatest_speed, slider_crank_rod_angle,
        slider_crank_rod_point, slider_crank_series, slider_crank_stroke,
    };
    #[pymodule_export]
    use super::remedies::remedies;
    #[pymodule_export]
    use super::run::Run;
    #[pymodule_export]
    use super::run::outcomes::Runs;
    #[pymodule_export]
    use super::search::PathSearch;
    #[pymodule_export]
    use super::spline::spline_pieces;
    #[pymodule_export]
    #[cfg(feature = "test-hooks")]
    use super::test_hooks::{panic_in_chunk, start_threads_at_once};
    #[pymodule_export]
    use super::trig::{asin, atan2, sin_cos, unit_angle};
    use super::{Bound, PyModule, PyResult, detach, pyfunction};

    #[pymodule_init]
    #[allow(clippy::unnecessary_wraps, reason = "PyO3 asks for a result")]
    fn init(_module: &Bound<'_, PyModule>) -> PyResult<()> {
        detach::record_panic_locations();
        Ok(())
    }

    /// The vector instructions in use: "baseline", "avx2" or "avx512".
    #[pyfunction]
    fn simd_level() -> &'static str {
        assur::Simd::allowed().name()
    }

    /// The version of the compiled core.
    #[pyfunction]
    fn version() -> &'static str {
        assur::VERSION
    }
}
