//! The matrix of the macro-step map of a linear scene, obtained by probing the co-simulation itself.
