//! The theory of two papers that has formulas of its own.
