//! A mechanism drawn elsewhere: at another coordinate, in another assembly, or with another driver.

use std::f64::consts::TAU;

use super::constants::DesignConstants;
use super::mechanism::{Mechanism, class_angles, drawing_signs, drawn_point, sine_of_legs};
use super::work_spaces::PlanNumber;
use crate::description::error::StructureError;
use crate::description::{Driver, Linkage};
use crate::math::tolerance::FLAT_SINE;
use crate::structure::closure::Rotation;

/// The places of all parts at one position.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Pose {
    /// Joints, m.
    pub joints: Vec<[f64; 2]>,
    /// Angles of all links, rad.
    pub angles: Vec<f64>,
    /// Values of all slides, m.
    pub slides: Vec<f64>,
}

/// The data of a drawing that a mechanism keeps besides the dimensions.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Drawing {
    pub q0: Vec<f64>,
    pub signs: Vec<i8>,
    /// Angle of every class, rad.
    pub class_angle: Vec<f64>,
    /// Value of every slide, m.
    pub slide_value: Vec<f64>,
}

impl Mechanism {
    /// The drawing that shows a pose.
    ///
    /// # Errors
    ///
    /// [`StructureError::FlatDyad`]: a dyad is flat there, so its assembly is not definite.
    pub(crate) fn drawing_of(&self, pose: &Pose) -> Result<Drawing, StructureError> {
        let linkage = self.linkage_at(pose);
        let coordinate = |&driver: &Driver| match driver {
            Driver::Slide(slide) => pose.slides[slide],
            Driver::Angle { link, relative_to } => pose.angles[link] - pose.angles[relative_to],
        };
        Ok(Drawing {
            q0: linkage.drivers.iter().map(coordinate).collect(),
            signs: drawing_signs(&linkage, &self.plan)?,
            class_angle: class_angles(&linkage, &self.plan),
            slide_value: pose.slides.clone(),
        })
    }

    /// The signs of all dyads in a pose, as [`Self::drawing_of`] finds them, where joints and angles of links
    /// are given; none if a dyad is flat.
    pub(crate) fn signs_of(&self, joints: &[[f64; 2]], angles: &[f64]) -> Option<Vec<i8>> {
        let (linkage, plan) = (&self.linkage, &self.plan);
        let at = |point: usize| match point.checked_sub(1) {
            Some(joint) if joint < joints.len() => joints[joint],
            None => [0.0; 2],
            Some(_) => {
                let (joints, angles) = (joints.to_vec(), angles.to_vec());
                let pose = Pose { joints, angles, slides: Vec::new() };
                drawn_point(&self.linkage_at(&pose), plan, point)
            }
        };
        let guide_angle = |slide: usize| {
            let slide = &linkage.slides[slide];
            slide.angle + (angles[slide.on] - linkage.drawing_angle(slide.on))
        };
        let mut signs = vec![1; plan.signs()];
        for dyad in plan.dyads() {
            let Some(sign) = dyad.sign else { continue };
            let sine = sine_of_legs(plan, dyad, at, guide_angle);
            if sine.abs() < FLAT_SINE || sine.is_nan() {
                return None;
            }
            signs[sign] = if sine > 0.0 { 1 } else { -1 };
        }
        Some(signs)
    }

    /// The linkage as drawn in a pose.
    fn linkage_at(&self, pose: &Pose) -> Linkage {
        let mut linkage = self.linkage.clone();
        linkage.assembly.clear();
        for (joint, &at) in linkage.joints.iter_mut().zip(&pose.joints) {
            joint.at = at;
        }
        for slide in &mut linkage.slides {
            slide.angle += pose.angles[slide.on] - self.linkage.drawing_angle(slide.on);
        }
        linkage
    }

    /// The mechanism drawn with these dimensions elsewhere. Its links' angles are in (−π, π] there.
    pub(crate) fn drawn_at(&self, dimensions: &[f64], drawing: Drawing) -> Self {
        let constants = DesignConstants::new(&self.plan, &self.slots, dimensions);
        let Drawing { q0, signs, class_angle, slide_value } = drawing;
        let principal = |(link, rotation): (usize, &Rotation)| {
            let driven: f64 = rotation.turns.iter().zip(&q0).map(|(&t, q)| f64::from(t) * q).sum();
            let angle = class_angle[rotation.class] + constants.offset[link] + driven;
            -(angle / TAU).round()
        };
        let whole_turns = self.plan.rotation.iter().enumerate().map(principal).collect();
        let mut drawn = self.clone();
        drawn.drawing = dimensions.to_vec();
        drawn.number = PlanNumber::next();
        (drawn.whole_turns, drawn.q0, drawn.signs) = (whole_turns, q0, signs);
        (drawn.class_angle, drawn.slide_value) = (class_angle, slide_value);
        drawn
    }
}
