// The sunlight that clouds and waves let through to the point that is lit.

// Whether waves shade each other; `casts_shadows` in src/render/water/light.rs tells when they do.
override WATER_SHADOWS: bool = false;

// Fraction of the sunlight that the waves let through to the point that is lit; a pass sets it once per pixel.
var<private> shadow_sun_fraction: f32 = 1.0;

// Irradiance by the sun, between clouds and waves, on a plane that faces it at the point that is lit.
fn shadow_sun_irradiance() -> vec3f {
  if WATER_SHADOWS {
    return cloud_sun_irradiance() * shadow_sun_fraction;
  }
  return cloud_sun_irradiance();
}
