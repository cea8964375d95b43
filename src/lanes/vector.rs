//! Eight vectors at once.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

use glam::{DVec3, Vec3};

use super::{F32x8, Mask8, Simd};

/// Eight vectors, or eight colours.
#[derive(Clone, Copy)]
pub struct Vec3x8<S: Simd> {
    pub x: F32x8<S>,
    pub y: F32x8<S>,
    pub z: F32x8<S>,
}

/// Eight vectors, by coordinate.
pub struct Rows([[f32; 8]; 3]);

impl Rows {
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> Vec3 {
        let [x, y, z] = &self.0;
        Vec3::new(x[lane], y[lane], z[lane])
    }
}

impl<S: Simd> Vec3x8<S> {
    #[inline(always)]
    pub fn new(x: F32x8<S>, y: F32x8<S>, z: F32x8<S>) -> Vec3x8<S> {
        Vec3x8 { x, y, z }
    }

    #[inline(always)]
    pub fn splat(v: Vec3) -> Vec3x8<S> {
        Vec3x8::new(F32x8::splat(v.x), F32x8::splat(v.y), F32x8::splat(v.z))
    }

    /// The same number three times.
    #[inline(always)]
    pub fn grey(x: F32x8<S>) -> Vec3x8<S> {
        Vec3x8::new(x, x, x)
    }

    #[inline(always)]
    pub fn zero() -> Vec3x8<S> {
        Vec3x8::splat(Vec3::ZERO)
    }

    /// Vectors that are rounded one by one.
    #[inline(always)]
    pub fn load(vectors: &[DVec3; 8]) -> Vec3x8<S> {
        let parts = vectors.map(|vector| vector.as_vec3());
        let (x, y, z) = (parts.map(|v| v.x), parts.map(|v| v.y), parts.map(|v| v.z));
        Vec3x8::new(F32x8::load(&x), F32x8::load(&y), F32x8::load(&z))
    }

    #[inline(always)]
    pub fn store(self) -> [Vec3; 8] {
        let rows = self.rows();
        std::array::from_fn(|lane| rows.lane(lane))
    }

    /// The same for those who take the lanes one by one. (Vectors that were put together from single numbers are slow
    /// to copy right afterwards: loads wait for smaller stores.)
    #[inline(always)]
    pub fn rows(self) -> Rows {
        Rows([self.x.store(), self.y.store(), self.z.store()])
    }

    #[inline(always)]
    pub fn dot(self, other: Vec3x8<S>) -> F32x8<S> {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    pub fn length(self) -> F32x8<S> {
        self.dot(self).sqrt()
    }

    #[inline(always)]
    pub fn normalized(self) -> Vec3x8<S> {
        self * self.length().recip()
    }

    /// Part by part.
    #[inline(always)]
    pub fn times(self, other: Vec3x8<S>) -> Vec3x8<S> {
        Vec3x8::new(self.x * other.x, self.y * other.y, self.z * other.z)
    }

    /// One over each part.
    #[inline(always)]
    pub fn recips(self) -> Vec3x8<S> {
        Vec3x8::new(self.x.recip(), self.y.recip(), self.z.recip())
    }

    /// The root of each part.
    #[inline(always)]
    pub fn roots(self) -> Vec3x8<S> {
        Vec3x8::new(self.x.sqrt(), self.y.sqrt(), self.z.sqrt())
    }

    /// The sum of a matrix's columns, each as often as a part says.
    #[inline(always)]
    pub fn by_columns(self, [x, y, z]: &[Vec3x8<S>; 3]) -> Vec3x8<S> {
        *x * self.x + *y * self.y + *z * self.z
    }

    #[inline(always)]
    pub fn lerp(self, other: Vec3x8<S>, share: F32x8<S>) -> Vec3x8<S> {
        self + (other - self) * share
    }

    #[inline(always)]
    pub fn min(self, other: Vec3x8<S>) -> Vec3x8<S> {
        Vec3x8::new(self.x.min(other.x), self.y.min(other.y), self.z.min(other.z))
    }

    #[inline(always)]
    pub fn max(self, other: Vec3x8<S>) -> Vec3x8<S> {
        Vec3x8::new(self.x.max(other.x), self.y.max(other.y), self.z.max(other.z))
    }

    #[inline(always)]
    pub fn max_element(self) -> F32x8<S> {
        self.x.max(self.y).max(self.z)
    }

    #[inline(always)]
    pub fn select(mask: Mask8<S>, yes: Vec3x8<S>, no: Vec3x8<S>) -> Vec3x8<S> {
        Vec3x8::new(mask.select(yes.x, no.x), mask.select(yes.y, no.y), mask.select(yes.z, no.z))
    }
}

impl<S: Simd> Add for Vec3x8<S> {
    type Output = Vec3x8<S>;

    #[inline(always)]
    fn add(self, other: Vec3x8<S>) -> Vec3x8<S> {
        Vec3x8::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<S: Simd> AddAssign for Vec3x8<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Vec3x8<S>) {
        *self = *self + other;
    }
}

impl<S: Simd> Sub for Vec3x8<S> {
    type Output = Vec3x8<S>;

    #[inline(always)]
    fn sub(self, other: Vec3x8<S>) -> Vec3x8<S> {
        Vec3x8::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<S: Simd> Mul<F32x8<S>> for Vec3x8<S> {
    type Output = Vec3x8<S>;

    #[inline(always)]
    fn mul(self, by: F32x8<S>) -> Vec3x8<S> {
        Vec3x8::new(self.x * by, self.y * by, self.z * by)
    }
}

impl<S: Simd> Neg for Vec3x8<S> {
    type Output = Vec3x8<S>;

    #[inline(always)]
    fn neg(self) -> Vec3x8<S> {
        Vec3x8::new(-self.x, -self.y, -self.z)
    }
}
