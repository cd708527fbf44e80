//! Structs that Rust and WGSL share. A test compares their layouts with the parsed shaders.

/// A WGSL struct as Rust sees it: its name, its members with their offsets in bytes, and its size in bytes. Members
/// whose names begin with `unused` are padding.
pub type Layout = (&'static str, &'static [(&'static str, usize)], usize);

/// Declares a struct that is sent to the GPU as it lies in memory, with its `LAYOUT` under the name that WGSL has for
/// it. Members stand in the order of the WGSL struct; padding is declared as members whose names begin with `unused`.
#[macro_export]
macro_rules! gpu_struct {
    ($(#[$meta:meta])* $vis:vis struct $rust:ident as $wgsl:literal {
        $($(#[$member_meta:meta])* $member_vis:vis $member:ident: $kind:ty,)+
    }) => {
        $(#[$meta])*
        #[repr(C)]
        #[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
        $vis struct $rust {
            $($(#[$member_meta])* $member_vis $member: $kind,)+
        }

        impl $rust {
            /// Compared with the WGSL struct by a test.
            pub const LAYOUT: $crate::gpu::layout::Layout = (
                $wgsl,
                &[$((stringify!($member), std::mem::offset_of!($rust, $member))),+],
                size_of::<$rust>(),
            );
        }
    };
}
pub use gpu_struct;
