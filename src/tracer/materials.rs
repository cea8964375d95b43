//! The materials of a scene as columns of numbers, so that each lane finds its own.

use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::scene::Material;

macro_rules! columns {
    ($($name:ident: $value:expr;)*) => {
        /// Materials by number; see [`Material`] for what the columns mean.
        #[derive(Default)]
        pub struct Materials {
            $($name: Vec<f32>,)*
        }

        impl Materials {
            /// Adds the materials of a surface, and gives back the number of the first.
            pub fn add(&mut self, materials: &[Material]) -> u32 {
                let first = self.ambient.len();
                $(
                    let value: fn(&Material) -> f64 = $value;
                    self.$name.extend(materials.iter().map(|material| value(material) as f32));
                )*
                first as u32
            }

            $(
                #[inline(always)]
                pub fn $name<S: Simd>(&self, number: U32x8<S>) -> F32x8<S> {
                    F32x8::gather(&self.$name, number)
                }
            )*
        }
    };
}

columns! {
    ambient: |material| material.finish.ambient;
    diffuse: |material| material.finish.diffuse;
    specular: |material| material.finish.specular;
    shininess: |material| material.finish.shininess;
    least_highlight: |material| least_highlight(material.finish.specular, material.finish.shininess);
    reflectivity: |material| material.finish.reflectivity;
    transparency: |material| material.finish.transparency;
    coat: |material| material.coat.coat;
    roughness: |material| material.coat.roughness;
    metal: |material| f64::from(u8::from(material.coat.metal));
    mean_red: |material| material.texture.mean().x;
    mean_green: |material| material.texture.mean().y;
    mean_blue: |material| material.texture.mean().z;
}

/// The cosine up to which a highlight adds nothing that could be seen: 2⁻³⁰ of its light.
fn least_highlight(specular: f64, shininess: f64) -> f64 {
    const UNSEEN: f64 = 1.0 / (1u64 << 30) as f64;
    if specular <= UNSEEN { f64::INFINITY } else { libm::pow(UNSEEN / specular, 1.0 / shininess) }
}

impl Materials {
    #[inline(always)]
    pub fn is_metal<S: Simd>(&self, number: U32x8<S>) -> Mask8<S> {
        self.metal(number).gt(F32x8::splat(0.5))
    }

    /// The mean colour of a large body.
    #[inline(always)]
    pub fn mean<S: Simd>(&self, number: U32x8<S>) -> Vec3x8<S> {
        Vec3x8::new(self.mean_red(number), self.mean_green(number), self.mean_blue(number))
    }
}
