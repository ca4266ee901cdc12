//! Designs × positions: a request solved into arrays, in blocks, on all cores.
