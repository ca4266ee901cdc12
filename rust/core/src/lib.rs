//! Planar linkages: description, Assur groups, position, analogues.
//!
//! A planar linkage is a driver plus Assur groups attached one after another.
//! [`Description`] says what the mechanism is; [`Mechanism`] finds its structure
//! and compiles it; [`Mechanism::solve`] gives positions and *analogues*
//! (derivatives with respect to the driver's coordinate) of many designs at many
//! positions.
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
//!     by: None,
//! })?;
//! let bore = &motion.slides[0];
//! let rod2 = 0.17_f64.powi(2) + 0.04_f64.powi(2);
//! assert!((bore.derivatives[0][0] - (rod2 - 0.05_f64.powi(2)).sqrt()).abs() < 1e-15);
//! assert!((bore.derivatives[1][0] + 0.05).abs() < 1e-15);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(
    test,
    allow(clippy::disallowed_methods, reason = "tests compare with the platform's functions")
)]

pub mod batch;
pub(crate) mod branch;
pub mod description;
pub mod dynamics;
pub mod math;
pub mod motion;
pub mod ode;
pub mod papers;

pub mod plan;
pub mod query;
pub(crate) mod state;
pub mod structure;

pub use batch::outputs::Outputs;
pub use batch::request::{Coordinates, Motion, Request, Track};
pub use description::class_iv::ClassIv;
pub use description::dimension::{Dimension, Dimensions};
pub use description::error::{Named, SolveError, StructureError};
pub use description::four_bar::{FourBar, FourBarMode};
pub use description::slider_crank::SliderCrank;
pub use description::{Description, Driver, DriverDescription, Linkage, SlideDescription};
pub use math::vector::Vector;
pub use plan::mechanism::Mechanism;
pub use query::diagnosis::Diagnosis;
pub use state::status::Status;
pub use structure::Structure;
pub use structure::assur_group::Group;

/// Version of the crate.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
