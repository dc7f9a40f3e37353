//! Counter-based draws and the landmark values that random draws never hit.

pub mod draw;
pub mod ggx;
pub mod landmarks;

pub use draw::{Draw, Stream};
