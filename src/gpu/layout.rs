//! Structs that Rust and WGSL share. They are declared once, in Rust, and their WGSL text is generated. A test compares the
//! layouts that both languages give them.

/// A type whose values lie in memory as those of a WGSL type do.
pub trait SharedType: bytemuck::Pod {
    /// The WGSL type.
    fn wgsl() -> String;
}

/// A struct declared by [`gpu_struct!`], so that arrays of it are WGSL arrays.
pub trait SharedStruct: SharedType {
    /// The name of the struct in WGSL.
    const NAME: &'static str;
}

macro_rules! shared_types {
    ($($rust:ty => $wgsl:literal,)+) => {
        $(impl SharedType for $rust {
            fn wgsl() -> String {
                $wgsl.to_owned()
            }
        })+
    };
}

shared_types! {
    f32 => "f32",
    u32 => "u32",
    i32 => "i32",
    [f32; 2] => "vec2f",
    [f32; 3] => "vec3f",
    [f32; 4] => "vec4f",
    [u32; 2] => "vec2u",
    [u32; 3] => "vec3u",
    [i32; 2] => "vec2i",
    glam::Mat2 => "mat2x2f",
    glam::Mat4 => "mat4x4f",
}

impl<const N: usize> SharedType for [[f32; 4]; N] {
    fn wgsl() -> String {
        format!("array<vec4f, {N}>")
    }
}

impl<T: SharedStruct, const N: usize> SharedType for [T; N] {
    fn wgsl() -> String {
        format!("array<{}, {N}>", T::NAME)
    }
}

/// A member of a shared struct.
#[derive(Clone, Copy, Debug)]
pub struct Member {
    /// The name in both languages.
    pub name: &'static str,
    /// Offset in bytes.
    pub offset: usize,
    /// Size in bytes.
    pub size: usize,
    /// The WGSL type.
    pub wgsl: fn() -> String,
}

impl Member {
    /// Whether the member only keeps the next one, or the size, at its alignment.
    pub fn is_padding(&self) -> bool {
        self.name.starts_with("unused")
    }
}

/// The declaration of a shared struct.
#[derive(Clone, Copy, Debug)]
pub struct Declaration {
    /// The name of the struct in WGSL.
    pub name: &'static str,
    /// Members of the struct, in order.
    pub members: &'static [Member],
    /// Size in bytes.
    pub size: usize,
}

impl Declaration {
    /// The struct in WGSL. Padding is declared word by word, because the alignment of a vector would move it.
    pub fn wgsl(&self) -> String {
        let lines = self.members.iter().map(|member| match member.is_padding() {
            true => (0..member.size / 4).map(|word| format!("  {}_{word}: u32,\n", member.name)).collect(),
            false => format!("  {}: {},\n", member.name, (member.wgsl)()),
        });
        format!("struct {} {{\n{}}}\n", self.name, lines.collect::<String>())
    }
}

/// Declares a struct that is sent to the GPU as it lies in memory. Rust's padding must be declared: as members of `u32` whose
/// names begin with `unused`.
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

        impl $crate::gpu::layout::SharedType for $rust {
            fn wgsl() -> String {
                $wgsl.to_owned()
            }
        }

        impl $crate::gpu::layout::SharedStruct for $rust {
            const NAME: &'static str = $wgsl;
        }

        impl $rust {
            /// Declaration of the struct in WGSL.
            pub const DECLARATION: $crate::gpu::layout::Declaration = $crate::gpu::layout::Declaration {
                name: $wgsl,
                members: &[$($crate::gpu::layout::Member {
                    name: stringify!($member),
                    offset: std::mem::offset_of!($rust, $member),
                    size: size_of::<$kind>(),
                    wgsl: <$kind as $crate::gpu::layout::SharedType>::wgsl,
                }),+],
                size: size_of::<$rust>(),
            };
        }
    };
}
pub use gpu_struct;
