//! Complex numbers in double precision.

use std::ops::{Add, AddAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A complex number `re` + i `im`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Complex {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
}

impl Complex {
    /// The number 0.
    pub const ZERO: Self = Self { re: 0.0, im: 0.0 };
    /// The number 1.
    pub const ONE: Self = Self { re: 1.0, im: 0.0 };
    /// The imaginary unit.
    pub const I: Self = Self { re: 0.0, im: 1.0 };

    /// Makes the number `re` + i `im`.
    pub const fn new(re: f64, im: f64) -> Self {
        Self { re, im }
    }

    /// The number with the given modulus and argument (rad).
    pub fn polar(modulus: f64, argument_rad: f64) -> Self {
        let (sin, cos) = argument_rad.sin_cos();
        Self::new(modulus * cos, modulus * sin)
    }

    /// Complex conjugate.
    #[must_use]
    pub fn conj(self) -> Self {
        Self::new(self.re, -self.im)
    }

    /// Square of the modulus.
    pub fn norm_squared(self) -> f64 {
        self.re * self.re + self.im * self.im
    }

    /// Modulus.
    pub fn modulus(self) -> f64 {
        self.re.hypot(self.im)
    }

    /// Argument, from -pi to pi (rad).
    pub fn argument(self) -> f64 {
        self.im.atan2(self.re)
    }

    /// Reciprocal; infinite or NaN for 0.
    #[must_use]
    pub fn recip(self) -> Self {
        let scale = 1.0 / self.norm_squared();
        Self::new(self.re * scale, -self.im * scale)
    }

    /// Principal square root, whose real part is not negative.
    #[must_use]
    pub fn sqrt(self) -> Self {
        Self::polar(self.modulus().sqrt(), 0.5 * self.argument())
    }
}

impl Add for Complex {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.im + other.im)
    }
}

impl Sub for Complex {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.re - other.re, self.im - other.im)
    }
}

impl Neg for Complex {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.re, -self.im)
    }
}

impl Mul for Complex {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)
    }
}

impl Mul<f64> for Complex {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self::new(self.re * factor, self.im * factor)
    }
}

impl AddAssign for Complex {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Complex {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl MulAssign for Complex {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl MulAssign<f64> for Complex {
    fn mul_assign(&mut self, factor: f64) {
        *self = *self * factor;
    }
}
