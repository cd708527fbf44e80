// Fresnel reflectance of a smooth piece of the water surface.

// Whether Schlick's approximation replaces the exact reflectance.
override WATER_SCHLICK: bool = false;

// Fresnel reflectance of a dielectric for unpolarised light. `cosine` is that of the angle of incidence, `contrast` the
// square of the refractive index of the second medium relative to the first, less 1, and the reciprocal of that
// difference, or 0 for media of equal index. Total reflection returns 1.
fn water_dielectric(cosine: f32, contrast: vec2f) -> f32 {
  let c = saturate(cosine);
  let g2 = contrast.x + c * c;
  if g2 <= 0.0 {
    return 1.0;
  }
  let g = sqrt(g2);
  let up = g - c;
  let down = g + c;
  // Amplitude of the light that is polarised across the plane of incidence, which is up / down, and the ratio to it of
  // the amplitude of the light that is polarised along that plane.
  let across = up * up * contrast.y;
  let along = (c * down - 1.0) / (c * up + 1.0);
  return 0.5 * across * across * (1.0 + along * along);
}

// Schlick's approximation of the Fresnel reflectance (1994), with a parameter in place of its exponent 5.
fn water_schlick(cosine: f32, index: f32) -> f32 {
  let r = (index - 1.0) / (index + 1.0);
  // pow(0, 0) is not defined.
  return mix(r * r, 1.0, pow(max(1.0 - saturate(cosine), 1e-6), material.schlick_exponent));
}

// Fresnel reflectance of the water in air, with the formula and the scale of the material.
fn water_fresnel(cosine: f32) -> f32 {
  if WATER_SCHLICK {
    return saturate(material.fresnel_scale * water_schlick(cosine, material.relative_index));
  }
  return saturate(material.fresnel_scale * water_dielectric(cosine, material.index_contrast));
}
