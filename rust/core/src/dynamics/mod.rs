//! Forces and motion of mechanisms referred to the driver.
//!
//! # Examples
//!
//! The moment's fluctuation of a press, and the flywheel that keeps the speed within 1/8 of 15 rad/s
//! (I. M. Matsyuk & E. M. Shlyakhov):
//!
//! ```
//! use assur::dynamics::{Ends, Flywheel, Mean, Turn};
//!
//! let phi: Vec<f64> = (0..9).map(|i| std::f64::consts::FRAC_PI_4 * f64::from(i)).collect();
//! let moment = [-0.23, -274.4, -950.5, 19.9, 1.26, -300.0, -23.9, -15.9, -0.23];
//! let inertia = [4.93, 5.07, 5.1, 5.1, 4.93, 5.05, 5.1, 5.14, 4.93];
//! let turn = Turn::new(&phi, &moment, &inertia, Ends::NotAKnot)?;
//! let flywheel = Flywheel::sized(turn, 0.125, 15.0, Mean::Extremes)?;
//! assert!((flywheel.inertia - 19.918150).abs() < 1e-6);
//! # Ok::<(), assur::dynamics::TableError>(())
//! ```

pub(crate) mod error;
pub(crate) mod flywheel;
pub(crate) mod line;
pub(crate) mod load;
pub(crate) mod machine;
pub(crate) mod motor;
pub(crate) mod pose;
pub(crate) mod reduced;
pub(crate) mod run;
pub(crate) mod spline;
pub(crate) mod table;
pub(crate) mod turn;
pub(crate) mod value;

pub use error::TableError;
pub use flywheel::{Flywheel, Mean};
pub use line::{Angle, Line};
pub use load::Load;
pub use machine::{Body, Machine, Rows};
pub use motor::{Characteristic, Motor};
pub use pose::Point;
pub use run::broken::Broken;
pub use run::evened::Wanted;
pub use run::make::RunError;
pub use run::outcome::{Ending, Happened, Moment, Moments, Run};
pub use run::outside::{Nothing, Outside};
pub use run::source::Sheet;
pub use run::steady::{Search, Steady};
pub use run::task::{Along, Occasion, Task, Watch};
pub use run::unsteady::Unsteady;
pub use spline::{Ends, Pieces, spline};
pub use table::Table;
pub use turn::{Extreme, Turn};
pub use value::Value;
