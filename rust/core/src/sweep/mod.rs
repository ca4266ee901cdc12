//! One number per design: metrics of its motion, without storing its positions.
//!
//! [`Mechanism::measure`] solves one design after another into the memory of a thread,
//! [`Metric`]s compute a number from each motion, [`Condition`]s drop designs early. The metrics here cover
//! frequent needs; others implement the trait.
//!
//! ```
//! use assur::sweep::{Coordinate, Span, Sweep};
//! use assur::{Control, Description, Mechanism};
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
//! let q = [0.0, std::f64::consts::PI];
//! let stroke = Span(Coordinate::slide(engine.slide("bore")?));
//! let sweep = Sweep { metrics: &[&stroke], ..Sweep::of(&engine, engine.drawing(), &q) };
//! let measures = engine.measure(&sweep, &Control::default())?;
//! assert!((measures.values[0][0] - 0.1).abs() < 1e-15);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`Mechanism::measure`]: crate::Mechanism::measure

mod combination;
mod coordinate;
mod course;
mod deviation;
mod evaluate_design;
mod extremes;
mod gradients;
mod least_transmission;
mod line_bounds;
mod means;
mod measure;
mod metric;
mod moments;
mod parts;
mod request;
mod targets;
mod threads;
mod time_ratio;

pub use combination::{Combination, Operand, Operation};
pub use coordinate::Coordinate;
pub use course::Course;
pub use deviation::{Deviation, Shape};
pub use extremes::{Decided, Extreme, IndexOf, PlaceOf, Span};
pub use least_transmission::{LeastTransmission, Line};
pub use means::{Mean, RootMeanSquare};
pub use metric::{Condition, Growth, MeanOf, Metric, Moves, Need, Positions, Relation, Slopes};
pub use parts::Part;
pub use request::{Gradients, Measured, Sweep};
pub use targets::{Fitted, FunctionError, PathDistance, PathError, PoseError};
pub use time_ratio::TimeRatio;
