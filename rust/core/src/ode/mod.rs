//! Non-stiff ordinary differential equations y' = f(t, y) by explicit Runge-Kutta pairs.
//!
//! A [`System`] is the right-hand side with its events and hooks. An [`Integrator`] integrates it,
//! with error control in each step and dense output ([`Output`]). Steps end at breaks of the
//! right-hand side in t ([`Options::breaks`]). Breaks in the state are events that restart the run
//! ([`Crossing::Boundary`], [`Action::Restart`]). A run ends early at the boundary of the domain
//! ([`Fault::OutOfDomain`], [`End::DomainBoundary`]) or at a limit of [`Options`].
//!
//! Sources: Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I, 2nd ed. 1993,
//! II.4 (step control, first step), II.5 and II.10 (pairs), II.6 (dense output).
//!
//! # Examples
//!
//! A pendulum released at 1 rad, up to its first rest on the other side:
//!
//! ```
//! use assur::ode::{Action, Crossing, End, Fault, Integrator, Method, Options, System};
//!
//! struct Pendulum;
//!
//! impl System for Pendulum {
//!     type Error = std::convert::Infallible;
//!
//!     fn rates(&mut self, _: f64, y: &[f64], rates: &mut [f64]) -> Result<(), Fault<Self::Error>> {
//!         rates[0] = y[1];
//!         rates[1] = -y[0].sin();
//!         Ok(())
//!     }
//!
//!     fn events(&mut self, _: f64, y: &[f64], values: &mut [f64]) -> Result<(), Self::Error> {
//!         values[0] = y[1];
//!         Ok(())
//!     }
//!
//!     fn on_event(&mut self, _: usize, _: f64, _: &mut [f64]) -> Result<Action, Self::Error> {
//!         Ok(Action::Stop)
//!     }
//! }
//!
//! let mut integrator = Integrator::new(Method::DormandPrince853, 2);
//! let options = Options { events: &[Crossing::Rising], ..Options::default() };
//! let run = integrator.run(&mut Pendulum, 0.0, &[1.0, 0.0], 100.0, &options)?;
//! assert_eq!(run.end, End::Event { index: 0, t: run.t });
//! assert!((run.y[0] + 1.0).abs() < 1e-9);
//! // Half of 2π / agm(1, cos 0.5).
//! assert!((run.t - 3.349987832).abs() < 1e-8);
//! # Ok::<(), assur::ode::Error<std::convert::Infallible>>(())
//! ```

pub(crate) mod check;
pub(crate) mod control;
pub(crate) mod error;
pub(crate) mod event;
pub(crate) mod event_location;
pub(crate) mod integrator;
pub(crate) mod lane_step;
pub(crate) mod options;
pub(crate) mod pair;
pub(crate) mod record;
pub(crate) mod run;
pub(crate) mod side_by_side;
pub(crate) mod solution;
mod step;
pub(crate) mod system;
#[cfg(test)]
mod tests;

pub use error::Error;
pub use integrator::Integrator;
pub use options::{LEAST_RELATIVE, Method, Options, Output};
pub use pair::dense::DenseOutput;
pub use solution::{End, Event, Solution, Statistics};
pub use system::{Action, Attempt, Crossing, Fault, Rates, System};
