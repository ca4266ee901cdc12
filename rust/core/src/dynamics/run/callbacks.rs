//! The user's functions in a run, and its cancellation.

use std::convert::Infallible;
use std::fmt::Display;
use std::marker::PhantomData;
use std::sync::atomic::{AtomicBool, Ordering};

/// Functions of time, coordinates and speeds, called on the thread of the run.
pub trait Callbacks {
    /// Error of a function.
    type Error: std::fmt::Display;

    /// Count of the numbers that `numbers` gives to loads and motors.
    fn count(&self) -> usize;

    /// The numbers for loads and motors, evaluated together with the equation of motion.
    ///
    /// # Errors
    ///
    /// Any error ends the run.
    fn numbers(
        &mut self,
        t: f64,
        q: &[f64],
        speed: &[f64],
        numbers: &mut [f64],
    ) -> Result<(), Self::Error>;

    /// Value of an event function.
    ///
    /// # Errors
    ///
    /// Any error ends the run.
    fn event(&mut self, which: usize, t: f64, q: &[f64], speed: &[f64])
    -> Result<f64, Self::Error>;

    /// Whether to end the run; checked every few steps.
    fn cancelled(&mut self) -> bool {
        false
    }
}

impl<O: Callbacks> Callbacks for &mut O {
    type Error = O::Error;

    fn count(&self) -> usize {
        (**self).count()
    }

    fn numbers(
        &mut self,
        t: f64,
        q: &[f64],
        speed: &[f64],
        numbers: &mut [f64],
    ) -> Result<(), O::Error> {
        (**self).numbers(t, q, speed, numbers)
    }

    fn event(&mut self, which: usize, t: f64, q: &[f64], speed: &[f64]) -> Result<f64, O::Error> {
        (**self).event(which, t, q, speed)
    }

    fn cancelled(&mut self) -> bool {
        (**self).cancelled()
    }
}

/// No functions and no cancellation.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoCallbacks;

impl Callbacks for NoCallbacks {
    type Error = Infallible;

    fn count(&self) -> usize {
        0
    }

    fn numbers(&mut self, _: f64, _: &[f64], _: &[f64], _: &mut [f64]) -> Result<(), Infallible> {
        Ok(())
    }

    fn event(&mut self, _: usize, _: f64, _: &[f64], _: &[f64]) -> Result<f64, Infallible> {
        Ok(f64::NAN)
    }
}

/// No functions; a flag cancels the run. `E`: the error of functions, of which there are none.
#[derive(Debug)]
pub struct UnlessCancelled<'c, E> {
    cancel: &'c AtomicBool,
    error: PhantomData<fn() -> E>,
}

impl<'c, E> UnlessCancelled<'c, E> {
    /// Runs are cancelled once this is true.
    #[must_use]
    pub fn new(cancel: &'c AtomicBool) -> Self {
        Self { cancel, error: PhantomData }
    }
}

impl<E: Display> Callbacks for UnlessCancelled<'_, E> {
    type Error = E;

    fn count(&self) -> usize {
        0
    }

    fn numbers(&mut self, _: f64, _: &[f64], _: &[f64], _: &mut [f64]) -> Result<(), E> {
        Ok(())
    }

    fn event(&mut self, _: usize, _: f64, _: &[f64], _: &[f64]) -> Result<f64, E> {
        Ok(f64::NAN)
    }

    fn cancelled(&mut self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }
}
