//! Steps that were taken back leave no trace.
