//! seastate
fn main() {}
