//! The system to integrate: right-hand side, events and hooks.

/// Why the right-hand side could not be evaluated.
#[derive(Debug, Clone, PartialEq)]
pub enum Fault<E> {
    /// The state is outside the domain, for example where a mechanism cannot be assembled. The
    /// integrator tries a smaller step and ends the run at the boundary of the domain.
    OutOfDomain,
    /// An error that ends the run.
    Error(E),
}

impl<E> From<E> for Fault<E> {
    fn from(error: E) -> Self {
        Self::Error(error)
    }
}

/// The action after an event. Among simultaneous events, the action last in this list wins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Action {
    /// Record the event and go on. Neither the state nor the right-hand side may have changed.
    Continue,
    /// Restart here: the state or the right-hand side has changed.
    Restart,
    /// End the run here.
    Stop,
}

/// The sign changes of an event function g that are events.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Crossing {
    /// From g < 0 to g ≥ 0, in the direction of the run. A start at zero is not an event.
    Rising,
    /// From g > 0 to g ≤ 0.
    Falling,
    /// Both.
    Either,
    /// As soon as g < 0: the right-hand side is valid on the piece g ≥ 0 only. A start or restart
    /// at zero is inside; one outside triggers the event at once.
    Boundary,
}

/// The last attempted step.
#[derive(Debug, Clone, Copy)]
pub struct Attempt {
    /// Its width, with its sign.
    pub h: f64,
    /// Where the last step ended that left the domain, if that is still ahead.
    pub refused: Option<f64>,
    /// Whether this or one of the last few left the domain, or aimed at its boundary.
    pub has_left_domain: bool,
}

/// A system of ordinary differential equations y' = f(t, y) with its events.
pub trait System {
    /// Error of the system's own functions.
    type Error;

    /// The right-hand side f. It must write all rates; NaN or infinity is rejected.
    ///
    /// # Errors
    ///
    /// [`Fault`], if the rates cannot be evaluated at this state.
    fn rates(&mut self, t: f64, y: &[f64], rates: &mut [f64]) -> Result<(), Fault<Self::Error>>;

    /// A smooth interval begins at `from` in state `y`, and ends at `to` or before: called at the
    /// start, at breaks and at restarts. Until the next call, `rates` must be one smooth function,
    /// both ends included. For a table over t whose knots are all breaks, this is the piece that
    /// contains (`from` + `to`) / 2.
    ///
    /// # Errors
    ///
    /// Any error ends the run.
    fn begin_interval(&mut self, from: f64, to: f64, y: &[f64]) -> Result<(), Self::Error> {
        let _ = (from, to, y);
        Ok(())
    }

    /// Event functions, one for each [`Crossing`] in the options. NaN where one is undefined: no
    /// event occurs there.
    ///
    /// # Errors
    ///
    /// Any error ends the run.
    fn events(&mut self, t: f64, y: &[f64], values: &mut [f64]) -> Result<(), Self::Error> {
        let _ = (t, y);
        values.fill(f64::NAN);
        Ok(())
    }

    /// The component of the state that is its only event function, if that is so.
    fn event_component(&self) -> Option<usize> {
        None
    }

    /// Greatest width, without its sign, of the next step toward the boundary of the domain: the widths of the
    /// few steps there follow from the state. 0 where the boundary is reached, `None` if no boundary is known
    /// ahead. Called after steps that left the domain, and after accepted ones.
    ///
    /// # Errors
    ///
    /// Any error ends the run.
    fn step_to_boundary(
        &mut self,
        t: f64,
        y: &[f64],
        last: Attempt,
    ) -> Result<Option<f64>, Self::Error> {
        let _ = (t, y, last);
        Ok(None)
    }

    /// Called for each recorded event. It may change the state if it restarts the run: at an
    /// impact, or to set q exactly to the table knot it has reached, so that rounding does not
    /// decide which piece it is on.
    ///
    /// # Errors
    ///
    /// Any error ends the run.
    fn on_event(&mut self, event: usize, t: f64, y: &mut [f64]) -> Result<Action, Self::Error> {
        let _ = (event, t, y);
        Ok(Action::Continue)
    }

    /// Whether an event may restart or end the run: then the step that it cuts ends with the rates there.
    fn may_cut(&self, event: usize) -> bool {
        let _ = event;
        true
    }

    /// Moves to a state whose rates were found without it, before its drift is asked for.
    fn place(&mut self, t: f64, y: &[f64]) {
        let _ = (t, y);
    }

    /// Starts to monitor an invariant. The last call of `rates` was for this state.
    fn watch_invariant(&mut self, t: f64, y: &[f64]) {
        let _ = (t, y);
    }

    /// Drift of an invariant over a step that ends in this state, in tolerances; above 1 the step
    /// is rejected. The last call of `rates` was for this state. (Like the stages, an error
    /// estimate misses a narrow feature between them.)
    fn drift(&mut self, t: f64, y: &[f64]) -> f64 {
        let _ = (t, y);
        0.0
    }

    /// The step of the last [`System::drift`] was accepted.
    fn keep_invariant(&mut self) {}

    /// Whether to cancel the run, for example after a signal or a deadline. Called every few steps.
    fn cancelled(&mut self) -> bool {
        false
    }
}

/// A closure as a [`System`] without events.
#[derive(Debug)]
pub struct Rates<F>(pub F);

impl<F, E> System for Rates<F>
where
    F: FnMut(f64, &[f64], &mut [f64]) -> Result<(), Fault<E>>,
{
    type Error = E;

    #[inline]
    fn rates(&mut self, t: f64, y: &[f64], rates: &mut [f64]) -> Result<(), Fault<E>> {
        self.0(t, y, rates)
    }
}
