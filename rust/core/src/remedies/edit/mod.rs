//! Edits of a description. None is tried here: what they give may still be no mechanism.

pub(super) mod drive;
pub(super) mod hold;
pub(super) mod insert;
pub(super) mod place;
pub(super) mod slide;
pub(super) mod take_out;
