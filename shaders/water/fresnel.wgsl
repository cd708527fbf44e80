// Reflectance of a smooth piece of the surface.

// Schlick's in place of the exact one.
override WATER_SCHLICK: bool = false;

// Unpolarised reflectance of a dielectric, from the cosine in the first medium and the second's relative index; total
// where the second is the thinner and light cannot enter.
fn water_dielectric(cosine: f32, index: f32) -> f32 {
  let c = clamp(cosine, 0.0, 1.0);
  let g2 = index * index - 1.0 + c * c;
  if g2 <= 0.0 {
    return 1.0;
  }
  let g = sqrt(g2);
  // Grazing light and no difference of the media: 0 / 0.
  let a = (g - c) / max(g + c, 1e-6);
  let b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
  return clamp(0.5 * a * a * (1.0 + b * b), 0.0, 1.0);
}

// Schlick 1994, with the exponent that he has at 5.
fn water_schlick(cosine: f32, index: f32) -> f32 {
  let r = (index - 1.0) / (index + 1.0);
  // pow(0, 0) is not defined.
  return mix(r * r, 1.0, pow(max(1.0 - clamp(cosine, 0.0, 1.0), 1e-6), material.fresnel_shine));
}

// Reflectance towards air as the material has it.
fn water_fresnel(cosine: f32) -> f32 {
  let index = material.index_water / material.index_air;
  if WATER_SCHLICK {
    return clamp(material.fresnel_scale * water_schlick(cosine, index), 0.0, 1.0);
  }
  return clamp(material.fresnel_scale * water_dielectric(cosine, index), 0.0, 1.0);
}

// Reflectance of a facet of this slope towards a direction.
fn water_facet_fresnel(dir: vec3f, slope: vec2f) -> f32 {
  return water_fresnel(dot(dir, water_normal(material.fresnel_normals * slope)));
}
