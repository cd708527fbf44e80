//! Structs that Rust and WGSL share. Each is declared once, in Rust, and its WGSL text is generated. A test compares
//! the memory layouts in both languages.

/// A Rust type whose memory layout is that of a WGSL type, so that its bytes can be copied to the GPU as they are.
pub trait SharedType: bytemuck::Pod {
    /// Returns the name of the WGSL type, such as `vec2f` for `[f32; 2]`.
    fn wgsl_type_name() -> String;
}

/// A struct that [`gpu_struct!`] declares, with its name in WGSL, from which names of array types are made.
pub trait SharedStruct: SharedType {
    /// The name of the struct in WGSL, which may differ from that in Rust.
    const WGSL_NAME: &'static str;
}

macro_rules! shared_types {
    ($($rust:ty => $wgsl:literal,)+) => {
        $(impl SharedType for $rust {
            fn wgsl_type_name() -> String {
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
    fn wgsl_type_name() -> String {
        format!("array<vec4f, {N}>")
    }
}

impl<T: SharedStruct, const N: usize> SharedType for [T; N] {
    fn wgsl_type_name() -> String {
        format!("array<{}, {N}>", T::WGSL_NAME)
    }
}

/// A member of a struct that is declared in Rust and in WGSL, with its place in memory.
#[derive(Clone, Copy, Debug)]
pub struct StructMember {
    /// Name of the member in Rust and in WGSL.
    pub name: &'static str,
    /// Offset of the member from the start of the struct, bytes, which is the same in Rust and in WGSL.
    pub offset: usize,
    /// Size of the member, bytes.
    pub size: usize,
    /// Function that returns the WGSL name of the member's type, such as `vec2f`.
    pub wgsl_type_name: fn() -> String,
}

impl StructMember {
    /// Whether the member is padding (its name begins with `unused`), which aligns the next member or fills the struct.
    pub fn is_padding(&self) -> bool {
        self.name.starts_with("unused")
    }
}

/// Declaration of a struct that Rust and WGSL share: all that is needed to generate its WGSL text.
#[derive(Clone, Copy, Debug)]
pub struct StructDeclaration {
    /// Name of the struct in WGSL, which may differ from that in Rust.
    pub name: &'static str,
    /// Members of the struct, in the order of their offsets.
    pub members: &'static [StructMember],
    /// Size of the struct, bytes.
    pub size: usize,
}

impl StructDeclaration {
    /// Text of the struct's declaration in WGSL. Padding is split into single u32 members, because WGSL would align
    /// padding of a vector type to a larger offset.
    pub fn wgsl_declaration(&self) -> String {
        let lines = self.members.iter().map(|member| match member.is_padding() {
            true => (0..member.size / 4).map(|word| format!("  {}_{word}: u32,\n", member.name)).collect(),
            false => format!("  {}: {},\n", member.name, (member.wgsl_type_name)()),
        });
        format!("struct {} {{\n{}}}\n", self.name, lines.collect::<String>())
    }
}

/// Declares a Rust struct that is copied to the GPU byte by byte, and generates its WGSL declaration. Padding must be
/// declared, too: as members of type `u32` or arrays of it, whose names begin with `unused`.
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
            fn wgsl_type_name() -> String {
                $wgsl.to_owned()
            }
        }

        impl $crate::gpu::layout::SharedStruct for $rust {
            const WGSL_NAME: &'static str = $wgsl;
        }

        impl $rust {
            /// Name, members and size of the struct, from which its WGSL declaration is generated.
            pub const DECLARATION: $crate::gpu::layout::StructDeclaration = $crate::gpu::layout::StructDeclaration {
                name: $wgsl,
                members: &[$($crate::gpu::layout::StructMember {
                    name: stringify!($member),
                    offset: std::mem::offset_of!($rust, $member),
                    size: size_of::<$kind>(),
                    wgsl_type_name: <$kind as $crate::gpu::layout::SharedType>::wgsl_type_name,
                }),+],
                size: size_of::<$rust>(),
            };
        }
    };
}
pub use gpu_struct;
