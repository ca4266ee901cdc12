//! Motion of machines under their loads and motors.

mod broken;
mod cycle;
mod equation;
mod evened;
mod make;
mod outcome;
mod outside;
mod reader;
mod shooting;
mod source;
mod steady;
mod tail;
mod task;
mod tolerances;
mod unsteady;
mod way;

pub use broken::Broken;
pub use evened::Wanted;
pub use make::RunError;
pub use outcome::{Ending, Happened, Moment, Moments, Run};
pub use outside::{Nothing, Outside};
pub use source::Sheet;
pub use steady::{Search, Steady};
pub use task::{Along, Occasion, Task, Watch};
pub use unsteady::Unsteady;
