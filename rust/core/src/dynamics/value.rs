//! Values in loads and motors: constant, tabulated or from a callback.

/// A value in a load or motor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// A constant.
    Number(f64),
    /// Index of one of the machine's tables over the first driver's coordinate.
    Table(usize),
    /// Index of one of the machine's curves over other coordinates.
    Over(usize),
    /// Index of one of the numbers that callbacks give at every evaluation.
    External(usize),
}

/// Values of tables and callbacks, and directions of motion, at the current state.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Numbers<'a> {
    /// Value and slope of every table.
    pub tables: &'a [[f64; 2]],
    /// Value of every curve over another coordinate, and its slope by the first driver's.
    pub over: &'a [[f64; 2]],
    /// Value of every callback and its derivative by the speed.
    pub external: &'a [[f64; 2]],
    /// Direction of every coordinate that a load follows: +1, −1 or, at rest, 0.
    pub ways: &'a [f64],
}

impl Value {
    pub(crate) fn at(self, numbers: Numbers<'_>) -> f64 {
        let value =
            |list: &[[f64; 2]], index: usize| list.get(index).map_or(f64::NAN, |pair| pair[0]);
        match self {
            Self::Number(number) => number,
            Self::Table(index) => value(numbers.tables, index),
            Self::Over(index) => value(numbers.over, index),
            Self::External(index) => value(numbers.external, index),
        }
    }

    /// Value and derivative by the coordinate, without callbacks.
    pub(crate) fn with_slope(self, numbers: Numbers<'_>) -> [f64; 2] {
        let pair =
            |list: &[[f64; 2]], index: usize| list.get(index).copied().unwrap_or([f64::NAN; 2]);
        match self {
            Self::Number(number) => [number, 0.0],
            Self::Table(index) => pair(numbers.tables, index),
            Self::Over(index) => pair(numbers.over, index),
            Self::External(_) => [f64::NAN; 2],
        }
    }

    /// The number, if it is a constant.
    pub(crate) fn number(&mut self) -> Option<&mut f64> {
        match self {
            Self::Number(number) => Some(number),
            Self::Table(_) | Self::Over(_) | Self::External(_) => None,
        }
    }

    /// The number, NaN of a table or a function.
    pub(crate) fn constant(self) -> f64 {
        match self {
            Self::Number(number) => number,
            Self::Table(_) | Self::Over(_) | Self::External(_) => f64::NAN,
        }
    }

    /// Derivative by the driver's speed.
    pub(crate) fn d_speed(self, numbers: Numbers<'_>) -> f64 {
        match self {
            Self::External(index) => numbers.external.get(index).map_or(f64::NAN, |pair| pair[1]),
            Self::Number(_) | Self::Table(_) | Self::Over(_) => 0.0,
        }
    }
}
