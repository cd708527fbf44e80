// The sunlight that clouds, waves, land and floating objects let through to the point that is lit.

// Whether waves shade each other; `waves_cast_shadows` in src/render/water/light.rs tells when they do.
override WATER_SHADOWS: bool = false;

// Whether something floats, which the water mirrors and which shades it (shaders/water/hull_image.wgsl).
override WATER_HULLS: bool = false;

// Share of a floating object's shadow in the light that comes up through the shaded surface, from the water and from the
// bed. That light has entered the water somewhere around, mostly beside a narrow hull.
const SHADOW_HULL_BELOW = 0.35;

// Fractions of the sunlight that waves and land, and that floating objects, let through to the point that is lit; a pass
// sets them once per pixel.
var<private> shadow_sun_fraction: f32 = 1.0;
var<private> shadow_hull_fraction: f32 = 1.0;

// Irradiance by the sun, between clouds, waves and land, on a plane that faces it at the point that is lit, where floating
// objects let the fraction `past_hulls` through.
fn shadow_sun_irradiance_past(past_hulls: f32) -> vec3f {
  if WATER_SHADOWS || WATER_HULLS || LAND_SHADOWS {
    return cloud_sun_irradiance() * (shadow_sun_fraction * past_hulls);
  }
  return cloud_sun_irradiance();
}

// Irradiance by the sun, between clouds, waves, land and hulls, on a plane that faces it at the point that is lit.
fn shadow_sun_irradiance() -> vec3f {
  return shadow_sun_irradiance_past(shadow_hull_fraction);
}

// Irradiance by the sun, as above, for light that comes up from the water and the bed: the shadow of a floating object
// counts by the share SHADOW_HULL_BELOW.
fn shadow_entering_sun_irradiance() -> vec3f {
  return shadow_sun_irradiance_past(mix(1.0, shadow_hull_fraction, SHADOW_HULL_BELOW));
}
