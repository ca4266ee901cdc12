//! All assemblies of a mechanism of any class.
pub(crate) mod assembly;
mod compare;
pub(crate) mod drawing_signs;
mod eliminant;
pub(crate) mod enumerate;
mod fibre;
mod follow;
mod forms;
mod homotopy;
mod linear;
mod parameters;
mod paths;
mod random;
mod redraw;
pub(crate) mod solutions;
