//! The part of a mechanism that results depend on: all else is neither read nor linearised.

use super::plan::SensitivityPlan;
use super::steps::{Component, ComponentKind, LinearStep, slide_along};
use crate::plan::dyad::Unknown;
use crate::plan::plan::{EdgeSlide, Plan};

/// The points, classes and slides whose derivatives are needed.
struct Needed {
    points: Vec<bool>,
    classes: Vec<bool>,
    slides: Vec<bool>,
}

impl SensitivityPlan<'_> {
    /// Leaves out steps, and columns of the solved motion, that no result depends on.
    pub(super) fn restrict_to_results(&mut self) {
        let plan = self.plan();
        let mut needed = Needed::by(plan, self.results.iter().flatten());
        // The last steps first: what a step needs, steps before it find.
        let mut steps: Vec<LinearStep> =
            std::mem::take(&mut self.steps).into_iter().rev().collect();
        steps.retain(|step| needed.by_step(plan, step));
        steps.reverse();
        self.steps = steps;
        let mut is_used = vec![false; plan.edges.len()];
        for step in &self.steps {
            match step {
                LinearStep::Place { edge, .. } => is_used[*edge] = true,
                LinearStep::Solve { closures, .. } => {
                    for &(edge, _) in closures.paths.iter().flat_map(|path| &path.edges) {
                        is_used[edge] = true;
                    }
                }
            }
        }
        self.edges.retain(|&edge| is_used[edge]);
        let (edges, links) = (&self.edges, &self.links);
        self.orientations.retain(|&o| edges.iter().any(|&e| plan.edges[e].orientation == o));
        self.read_slides.retain(|&slide| {
            edges.iter().any(|&e| slide_along(plan.edges[e].along) == Some(slide))
        });
        let links: Vec<usize> = self.orientations.iter().filter_map(|&o| links[o]).collect();
        self.outputs.directions.clone_from(&links);
        self.outputs.rates = links;
        self.outputs.slides.clone_from(&self.read_slides);
    }
}

impl Needed {
    fn by<'c>(plan: &Plan, components: impl Iterator<Item = &'c Component>) -> Self {
        let mut needed = Self {
            points: vec![false; plan.points],
            classes: vec![false; plan.classes],
            slides: vec![false; plan.slide_links.len()],
        };
        for component in components {
            match component.kind {
                ComponentKind::X { point } | ComponentKind::Y { point } => {
                    needed.points[point] = true;
                }
                ComponentKind::Slide(slide) => needed.slides[slide] = true,
                ComponentKind::Angle { class, .. } => needed.classes[class] = true,
            }
        }
        needed
    }

    /// Whether a step finds what is needed; if so, what it depends on is needed too.
    fn by_step(&mut self, plan: &Plan, step: &LinearStep) -> bool {
        match step {
            &LinearStep::Place { edge, from, to, .. } => {
                let finds = self.points[to];
                if finds {
                    self.points[from] = true;
                    self.add_edge(plan, edge);
                }
                finds
            }
            LinearStep::Solve { closures, .. } => {
                let finds = closures.unknowns.iter().any(|&unknown| match unknown {
                    Unknown::Class(class) => self.classes[class],
                    Unknown::Slide(slide) => self.slides[slide],
                });
                if finds {
                    for path in &closures.paths {
                        (self.points[path.plus], self.points[path.minus]) = (true, true);
                        for &(edge, _) in &path.edges {
                            self.add_edge(plan, edge);
                        }
                    }
                }
                finds
            }
        }
    }

    fn add_edge(&mut self, plan: &Plan, edge: usize) {
        self.classes[plan.edges[edge].class] = true;
        if let EdgeSlide::Slide(slide) = plan.edges[edge].along {
            self.slides[slide] = true;
        }
    }
}
