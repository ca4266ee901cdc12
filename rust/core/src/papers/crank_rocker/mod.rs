//! The crank-rocker with friction, in the convention of its paper.
//!
//! Crank l₁ at A, coupler l₂, rocker l₃ at D and ground l₄ = AD, which may change with time. φ₁ is
//! zero where the crank pin is farthest from D. V. K. Manzhosov and T. E. Petrova, Modelling of the
//! motion of the crank-rocker mechanism with non-ideal constraints (in Russian), sections 1 and 2.
//!
//! # Examples
//!
//! The paper's figure 8: the mechanism jams before the crank points away from the rocker, and the
//! rocker's support returns after it.
//!
//! ```
//! use assur::papers::crank_rocker::{Case, Kind, run};
//!
//! let case = Case {
//!     lengths: [1.0, 4.5, 1.5],
//!     gamma_min: [0.2; 2],
//!     speed: 1.0,
//!     phi0: 1.5,
//!     turns: 1.0,
//! };
//! let (rows, events) = run(&case, |_| Ok::<f64, ()>(4.995)).expect("a free start");
//! assert_eq!([events[0].kind, events[1].kind], [Kind::Jam, Kind::Return]);
//! assert!((events[0].phi1.to_degrees() - 348.2559026309).abs() < 1e-9);
//! assert!(rows.iter().any(|row| row.sliding));
//! ```

pub(crate) mod case;
pub(crate) mod jamming;
pub(crate) mod motion;
pub(crate) mod run;
pub(crate) mod zone;

pub use case::{Case, Event, JammingError, Kind, Row, Side};
pub use motion::{Assembly, Lengths, Position, Rates, position};
pub use run::run;
pub use zone::{
    Grashof, blocked, crank_turns, exact_least_gamma, grashof, ground_range, least_gamma, margins,
    transmission_extremes,
};
