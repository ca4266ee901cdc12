//! Numbers that loads and motors have.

/// A number, or where it is read at every place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// Always the same.
    Number(f64),
    /// Over the first driver's coordinate: which of the machine's tables.
    Table(usize),
    /// Given from outside at every place: which of the numbers.
    External(usize),
}

/// What is read at a place.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Numbers<'a> {
    /// Value of every table, and its slope.
    pub tables: &'a [[f64; 2]],
    /// Numbers from outside, and their slopes by the speed.
    pub external: &'a [[f64; 2]],
}

impl Value {
    pub(crate) fn at(self, numbers: Numbers<'_>) -> f64 {
        let of = |list: &[[f64; 2]], which: usize| list.get(which).map_or(f64::NAN, |pair| pair[0]);
        match self {
            Self::Number(number) => number,
            Self::Table(which) => of(numbers.tables, which),
            Self::External(which) => of(numbers.external, which),
        }
    }

    /// Its derivative by the driver's speed.
    pub(crate) fn d_speed(self, numbers: Numbers<'_>) -> f64 {
        match self {
            Self::External(which) => numbers.external.get(which).map_or(f64::NAN, |pair| pair[1]),
            Self::Number(_) | Self::Table(_) => 0.0,
        }
    }
}
