//! Planar linkages: description, Assur groups, position, analogues.
//!
//! A planar linkage is a driver plus Assur groups attached one after another.
//! [`Description`] defines a mechanism; [`Mechanism`] finds its structure and compiles it;
//! [`Mechanism::solve`] computes positions and *analogues* (derivatives by the driver's
//! coordinate) of many designs at many positions.
//!
//! # Examples
//!
//! A central slider-crank at 90°:
//!
//! ```
//! use assur::{Coordinates, Description, Mechanism, Outputs, Request};
//!
//! let engine = Mechanism::new(
//!     &Description::new()
//!         .joint("O", [0.0, 0.0])
//!         .joint("A", [0.03, 0.04])
//!         .joint("B", [0.2, 0.0])
//!         .link("ground", ["O"])
//!         .link("crank", ["O", "A"])
//!         .link("rod", ["A", "B"])
//!         .link("piston", ["B"])
//!         .slide("bore", "piston", "ground", 0.0, Some("O"))
//!         .driver("crank"),
//! )?;
//! let motion = engine.solve(&Request {
//!     dimensions: engine.drawing(),
//!     coordinates: Coordinates::Shared(&[std::f64::consts::FRAC_PI_2]),
//!     signs: engine.signs(),
//!     order: 1,
//!     outputs: &Outputs::all(&engine),
//! })?;
//! let bore = &motion.slides[0];
//! let rod2 = 0.17_f64.powi(2) + 0.04_f64.powi(2);
//! assert!((bore.derivatives[0][0] - (rod2 - 0.05_f64.powi(2)).sqrt()).abs() < 1e-15);
//! assert!((bore.derivatives[1][0] + 0.05).abs() < 1e-15);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`dynamics`] moves machines under loads and motors; [`ode`] is the integrator it uses.
#![warn(unreachable_pub)] // the interface of the crate is listed here
#![cfg_attr(
    test,
    allow(clippy::disallowed_methods, reason = "tests compare with the platform's functions")
)]

// The layers, from the bottom up: math, ode, description, structure, plan, state, branch, query,
// remedies, batch, sensitivity, assemblies, inverse, sweep, dynamics, population, search, fit, papers. Each imports only from those below it
// (`tools/check_order`).
mod assemblies;
mod batch;
mod branch;
mod description;
pub mod dynamics;
mod fit;
mod inverse;
mod math;
pub mod ode;
pub mod papers;
mod plan;
mod population;
mod query;
mod remedies;
mod search;
mod sensitivity;
mod state;
mod structure;
pub mod sweep;

pub use assemblies::assembly::{Assemblies, Assembly, PathFailure};
pub use assemblies::solutions::PathEnd;
#[doc(hidden)]
pub use batch::bench_hooks;
pub use batch::failure_log::{FailureLog, FirstFailure};
pub use batch::helpers::available_threads;
pub use batch::known_signs::KnownSigns;
pub use batch::request::{Arrays, Column, Outputs, Quantity};
pub use batch::request::{Coordinates, Motion, Request, Series};
pub use batch::schedule::{Checks, Control};
pub use batch::solve::fill;
#[cfg(feature = "test-hooks")]
#[doc(hidden)]
pub use batch::test_hooks;
pub use description::class_iv::ClassIv;
pub use description::dimension::{Dimension, Dimensions};
pub use description::error::{
    DriverFault, Hint, Item, Named, Overconstraint, SolveError, StructureError,
};
pub use description::four_bar::{FourBar, FourBarMode};
pub use description::frame::Axis;
pub use description::slider_crank::SliderCrank;
pub use description::{
    Description, Driver, DriverDescription, Joint, Link, Linkage, Slide, SlideDescription,
};
pub use fit::conditions::{Aim, FitCondition};
pub use fit::fit::{Fit, Fitted};
pub use fit::problem::{FitRequest, Travel};
pub use fit::target::{FitTarget, Freedom, TargetNumber, Timing};
pub use fit::variables::Variable;
pub use inverse::answers::{Answer, Answers};
pub use inverse::find::Finder;
pub use inverse::inverse::Inverse;
pub use inverse::near::{Followed, Start};
pub use math::simd::Simd;
pub use math::vector::Vector;
// For the binding (`assur._trig`), tests and benches: no part of the public face.
#[doc(hidden)]
pub use math::{lanes, pair::Lanes, tolerance, trig};
pub use plan::mechanism::Mechanism;
pub use plan::redraw::Pose;
pub use query::diagnosis::Diagnosis;
pub use query::extremes::tracked::{Tracked, ValueAt};
pub use query::failure::{Failure, GroupName, Reason};
pub use query::limits::finder::{Interval, Limits, LimitsFinder, Tables};
pub use query::metrics;
pub use remedies::{Remedy, RemedyKind, remedies};
pub use search::path_search::{FoundLinkage, PathSearch, SearchRequest};
pub use sensitivity::request::{Product, SensitivityRequest};
pub use state::status::Status;
pub use structure::Structure;
pub use structure::assur_group::Group;
pub use structure::closure::LeftOut;
pub use structure::drawing_change::Change;
pub use structure::fitted::fit;

/// Version of the crate.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
