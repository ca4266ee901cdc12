//! The variable over which a run is integrated.

/// Independent variable of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variable {
    /// The time.
    Time,
    /// The coordinate of a single driver.
    Coordinate,
}

impl Variable {
    /// Its symbol in messages.
    pub(crate) fn symbol(self) -> &'static str {
        match self {
            Self::Time => "t",
            Self::Coordinate => "q",
        }
    }
}
