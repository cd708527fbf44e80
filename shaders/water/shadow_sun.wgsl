// The sunlight that clouds, waves, land and floating objects let through to the point that is lit.

// Whether waves shade each other; `waves_cast_shadows` in src/render/water/light.rs tells when they do.
override WATER_SHADOWS: bool = false;

// Whether something floats, which the water mirrors and which shades it (shaders/water/hull_image.wgsl).
override WATER_HULLS: bool = false;

// Fraction of the sunlight that waves, land and hulls let through to the point that is lit; a pass sets it once per pixel.
var<private> shadow_sun_fraction: f32 = 1.0;

// Irradiance by the sun, between clouds, waves, land and hulls, on a plane that faces it at the point that is lit.
fn shadow_sun_irradiance() -> vec3f {
  if WATER_SHADOWS || WATER_HULLS || LAND_SHADOWS {
    return cloud_sun_irradiance() * shadow_sun_fraction;
  }
  return cloud_sun_irradiance();
}
