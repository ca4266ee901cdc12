//! How far a coordinate is from given values at given positions.

use std::f64::consts::TAU;

use crate::batch::request::Quantity;
use crate::math::angle::unwrap_to;
use crate::sweep::coordinate::Coordinate;
use crate::sweep::course::Course;
use crate::sweep::metric::{Metric, Need, Positions, Slopes};

/// What of the relation between a coordinate and given values is free.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fitted {
    /// Nothing: x − v is to be 0. Of an angle one number of whole turns is.
    Nothing,
    /// The offset: x − v is to be constant.
    Offset,
    /// Scale and offset: a x + b is to be v, with the best a and b. Scaled values, not a scaled coordinate, would
    /// be matched by one at rest.
    ScaleAndOffset,
}

/// The root mean square difference between a coordinate and given values at some of the positions.
#[derive(Debug, Clone, PartialEq)]
pub struct FunctionError {
    of: Coordinate,
    /// Index of a position and the value there, in the order in which an angle is continuous.
    wanted: Vec<(usize, f64)>,
    fitted: Fitted,
}

/// The differences at the wanted positions.
struct Differences {
    each: Vec<f64>,
    /// The derivative of each by its coordinate, without what a fit absorbs.
    by_coordinate: f64,
}

impl Differences {
    fn root_mean_square(&self) -> f64 {
        mean(self.each.iter().map(|difference| difference * difference)).sqrt()
    }
}

impl FunctionError {
    /// Of a coordinate, with the values that it is to have at positions, by their indices. Angles count modulo whole
    /// turns: from each of these positions to the next the difference changes by less than half a turn; of an
    /// angle whose scale is free, the angle itself.
    #[must_use]
    pub fn new(of: Coordinate, wanted: Vec<(usize, f64)>, fitted: Fitted) -> Self {
        Self { of, wanted, fitted }
    }

    fn differences(&self, positions: &Positions<'_>) -> Differences {
        let all: Vec<f64> = self.of.values(positions).collect();
        let is_angle = matches!(self.of.need, Need { quantity: Quantity::Angle(_), order: 0 });
        let is_scaled = self.fitted == Fitted::ScaleAndOffset;
        let mut last = None;
        let mut each = Vec::with_capacity(self.wanted.len());
        for &(place, value) in &self.wanted {
            let actual = all.get(place).copied().unwrap_or(f64::NAN);
            let plain = if is_scaled { actual } else { actual - value };
            let near = last.unwrap_or(plain);
            let continued = if is_angle { unwrap_to(plain, near) } else { plain };
            last = Some(continued);
            each.push(continued);
        }
        let middle = mean(each.iter().copied());
        match self.fitted {
            Fitted::Nothing => {
                let turns = if is_angle { (middle / TAU).round() } else { 0.0 };
                for difference in &mut each {
                    *difference -= TAU * turns;
                }
                Differences { each, by_coordinate: 1.0 }
            }
            Fitted::Offset => {
                for difference in &mut each {
                    *difference -= middle;
                }
                Differences { each, by_coordinate: 1.0 }
            }
            Fitted::ScaleAndOffset => self.scaled(each, middle),
        }
    }

    /// The differences of the line of least squares through values over coordinates; of a coordinate at rest
    /// those of the values from their mean.
    fn scaled(&self, mut coordinates: Vec<f64>, middle: f64) -> Differences {
        let mean_value = mean(self.wanted.iter().map(|&(_, value)| value));
        let (mut square, mut product) = (0.0, 0.0);
        for (&x, &(_, value)) in coordinates.iter().zip(&self.wanted) {
            square += (x - middle) * (x - middle);
            product += (x - middle) * (value - mean_value);
        }
        let scale = if square > 0.0 { product / square } else { 0.0 };
        for (x, &(_, value)) in coordinates.iter_mut().zip(&self.wanted) {
            *x = scale * (*x - middle) - (value - mean_value);
        }
        Differences { each: coordinates, by_coordinate: scale }
    }
}

impl Metric for FunctionError {
    fn needs(&self) -> Vec<Need> {
        vec![self.of.need]
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        self.differences(positions).root_mean_square()
    }

    fn with_slopes(&self) -> Option<&dyn Slopes> {
        Some(self)
    }

    fn check(&self, course: &Course<'_>) -> Result<(), String> {
        course.check_one_driver("a function of the driver's coordinate")?;
        let count = course.count();
        match self.wanted.iter().find(|&&(place, _)| place >= count) {
            Some((place, _)) => Err(format!("there is no position {place}: q has {count}")),
            None if self.wanted.is_empty() => Err("it has no values".into()),
            None => Ok(()),
        }
    }
}

impl Slopes for FunctionError {
    fn slopes(&self, positions: &Positions<'_>) -> Vec<Vec<f64>> {
        let differences = self.differences(positions);
        let width = self.of.need.width();
        let mut slopes = vec![0.0; positions.count() * width];
        // d√m = dm / 2√m: of 0 none. What is fitted is best already, and adds nothing.
        let count = self.wanted.len() as f64;
        let scale = differences.by_coordinate / (count * differences.root_mean_square());
        for (&(place, _), difference) in self.wanted.iter().zip(&differences.each) {
            let component = self.of.component.min(width - 1);
            if let Some(slope) = slopes.get_mut(place * width + component) {
                *slope += scale * difference;
            }
        }
        vec![slopes]
    }
}

/// NaN without numbers.
fn mean(numbers: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = numbers.len() as f64;
    numbers.sum::<f64>() / count
}
