//! Edits of a description. They are not tried here: the result may still not be a mechanism.

pub(super) mod drive;
pub(super) mod hold;
pub(super) mod insert;
pub(super) mod place;
pub(super) mod slide;
pub(super) mod take_out;
