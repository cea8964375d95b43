//! The letters of captions: Inter, with its licence beside it in `fonts/OFL.txt`.

/// The regular weight, an OpenType file.
pub const REGULAR: &[u8] = include_bytes!("fonts/Inter-Regular.otf");

/// The bolder one.
pub const BOLD: &[u8] = include_bytes!("fonts/Inter-SemiBold.otf");
