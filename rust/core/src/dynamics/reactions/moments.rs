//! Moments in slides and torques of drivers, from the balance of each link that turns with others.

use super::force_plan::{ForcePlan, MomentPair};
use super::scene::Scene;
use crate::math::lanes::Real;

impl<R: Real> Scene<R> {
    /// Finds the moments between links that turn together: each link passes its own on.
    #[inline(always)]
    pub(crate) fn pass_moments(&mut self, plan: &ForcePlan) {
        for step in &plan.moments {
            let on_link = -self.moment[step.link];
            let passed = self.moment[step.to] - on_link;
            self.moment[step.to] = passed;
            match step.through {
                MomentPair::Slide(slide) => {
                    let is_sliding = plan.slide_links[slide][0] == step.link;
                    self.slide_moment[slide] += if is_sliding { on_link } else { -on_link };
                }
                MomentPair::Driver(driver) => {
                    let is_driven = plan.driven_links[driver] == Some(step.link);
                    self.driver[driver] = if is_driven { on_link } else { -on_link };
                }
            }
        }
        for (slide, driver) in plan.slide_drivers.iter().enumerate() {
            if let &Some(driver) = driver {
                self.driver[driver] = -self.sliding[slide];
            }
        }
    }
}
