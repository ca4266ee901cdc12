//! A path to draw: points, or a line through them, in a frame where its size is 1.

use crate::math::polyline::{Place, Polyline, Walk};

/// Equal parts into which a line is cut; the middle of each stands for it. With twice as many the distances
/// of smooth paths change by about 10⁻⁴ of themselves.
pub(super) const SAMPLES: usize = 256;

/// Where a path is, and how large: its points are in the frame of its centroid, over its root mean square distance
/// from it.
#[derive(Debug, Clone)]
pub(super) struct Frame {
    centre: [f64; 2],
    pub radius: f64,
}

impl Frame {
    /// A point in this frame.
    pub(super) fn enter(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [(x - self.centre[0]) / self.radius, (y - self.centre[1]) / self.radius]
    }
}

/// A line to draw, closed or not.
#[derive(Debug, Clone)]
pub(super) struct LineTarget {
    pub line: Polyline<2>,
    /// The middles of equal parts.
    pub samples: Vec<[f64; 2]>,
    pub is_closed: bool,
}

/// The points of a path in their frame, each with the same weight.
///
/// # Errors
///
/// The reason why they have no size.
pub(super) fn points_in_frame(points: &[[f64; 2]]) -> Result<(Frame, Vec<[f64; 2]>), String> {
    let outer = Frame::around(points)?;
    let bars: Vec<Bar> =
        points.iter().map(|&point| Bar { middle: outer.enter(point), length: 0.0 }).collect();
    let frame = outer.of_bars(&bars, |_| 1.0);
    let points = points.iter().map(|&point| frame.enter(point)).collect();
    Ok((frame, points))
}

impl LineTarget {
    /// The line through points in its frame. Without a word it is closed if the last point is the first.
    ///
    /// # Errors
    ///
    /// The reason why it has no size, or cannot be closed.
    pub(super) fn new(
        points: &[[f64; 2]],
        is_closed: Option<bool>,
    ) -> Result<(Frame, Self), String> {
        let outer = Frame::around(points)?;
        let mut corners = points.to_vec();
        corners.dedup();
        let ends_where_it_begins = corners.first() == corners.last();
        let is_closed = is_closed.unwrap_or(ends_where_it_begins);
        if is_closed && ends_where_it_begins {
            corners.pop();
        }
        if is_closed && corners.len() < 3 {
            let count = corners.len();
            return Err(format!("{count} points do not make a closed path: 3 are needed"));
        }
        let scaled: Vec<[f64; 2]> = corners.iter().map(|&corner| outer.enter(corner)).collect();
        let line = Polyline::through(&scaled, is_closed);
        let bar = |segment: usize| Bar {
            middle: line.point(Place { segment, part: 0.5 }),
            length: line.length(segment),
        };
        let bars: Vec<Bar> = (0..line.len()).map(bar).collect();
        let frame = outer.of_bars(&bars, |bar| bar.length);
        for corner in &mut corners {
            *corner = frame.enter(*corner);
        }
        let line = Polyline::through(&corners, is_closed);
        let part = line.total() / SAMPLES as f64;
        let mut walk = Walk::new(&line);
        let samples = (0..SAMPLES).map(|k| line.point(walk.to((k as f64 + 0.5) * part))).collect();
        Ok((frame, Self { line, samples, is_closed }))
    }
}

/// A straight piece of a line; a point has no length.
struct Bar {
    middle: [f64; 2],
    length: f64,
}

impl Frame {
    /// About the first point, over the greatest coordinate from it: there squares neither overflow nor vanish.
    fn around(points: &[[f64; 2]]) -> Result<Self, String> {
        let Some(&centre) = points.first() else { return Err("it is empty".into()) };
        if let Some(at) = points.iter().position(|[x, y]| !(x.is_finite() && y.is_finite())) {
            return Err(format!("entry {at} is not finite"));
        }
        let far = |most: f64, [x, y]: &[f64; 2]| {
            most.max((x - centre[0]).abs()).max((y - centre[1]).abs())
        };
        let radius = points.iter().fold(0.0, far);
        match radius {
            _ if radius > 0.0 && radius.is_finite() => Ok(Self { centre, radius }),
            _ if radius > 0.0 => Err("its points are too far apart for numbers".into()),
            _ if points.len() == 1 => {
                Err("one point has no size: two different ones are needed".into())
            }
            _ => Err(format!(
                "all {} points are the same: two different ones are needed",
                points.len()
            )),
        }
    }

    /// The frame of bars with these weights that are given in this frame.
    fn of_bars(&self, bars: &[Bar], weight: impl Fn(&Bar) -> f64) -> Self {
        let total: f64 = bars.iter().map(&weight).sum();
        let mut mean = [0.0; 2];
        for bar in bars {
            let part = weight(bar) / total;
            mean = [0, 1].map(|k| mean[k] + part * bar.middle[k]);
        }
        let mut square = 0.0;
        for bar in bars {
            let [x, y] = [0, 1].map(|k| bar.middle[k] - mean[k]);
            square += weight(bar) / total * (x * x + y * y + bar.length * bar.length / 12.0);
        }
        let centre = [0, 1].map(|k| self.centre[k] + self.radius * mean[k]);
        Self { centre, radius: self.radius * square.sqrt() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[f64; 2]; 4] = [[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0]];

    #[test]
    fn a_square_has_its_radius() {
        let (frame, target) = LineTarget::new(&SQUARE, Some(true)).expect("a path");
        assert_eq!(frame.centre, [2.0, 2.0]);
        // Over a side 1 + t², t from −1 to 1: 4/3.
        assert!((frame.radius - (4.0_f64 / 3.0).sqrt()).abs() < 1e-15);
        assert_eq!(target.line.len(), 4);
        let (frame, _) = points_in_frame(&SQUARE).expect("a path");
        assert!((frame.radius - 2.0_f64.sqrt()).abs() < 1e-15);
        let huge = SQUARE.map(|point| point.map(|number| 1e160 * number));
        assert!(LineTarget::new(&huge, None).expect("a path").0.radius < 1.2e160);
    }

    #[test]
    fn it_is_closed_if_it_ends_where_it_begins() {
        let [a, b, c, d] = SQUARE;
        let round = LineTarget::new(&[a, a, b, c, d, a], None).expect("a path").1;
        assert!(round.is_closed && round.line.len() == 4);
        assert_eq!(LineTarget::new(&SQUARE, None).expect("a path").1.line.len(), 3);
        let back = LineTarget::new(&[a, b, c, d, a], Some(false)).expect("a path").1;
        assert!(!back.is_closed && back.line.len() == 4);
    }

    #[test]
    fn what_has_no_size_is_refused() {
        for points in [&[][..], &[[1.0, 2.0]], &[[1.0, 2.0]; 3], &[[0.0, f64::NAN], [1.0, 1.0]]] {
            assert!(points_in_frame(points).is_err());
            assert!(LineTarget::new(points, None).is_err());
        }
        let two = [[0.0, 0.0], [1.0, 1.0]];
        assert!(LineTarget::new(&two, Some(true)).is_err());
        assert!(LineTarget::new(&two, None).is_ok());
    }
}
