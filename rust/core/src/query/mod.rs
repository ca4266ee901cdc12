//! One design, asked: what happened at a position, which assemblies there are, positions in sequence.
