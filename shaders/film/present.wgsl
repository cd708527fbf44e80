// Shows the finished picture on the canvas: copied if both have the same size, else scaled. In the picture, alpha is
// the luma of the colour.

@group(0) @binding(0) var picture_map: texture_2d<f32>;
@group(0) @binding(1) var picture_sampler: sampler;

// Shape of the upscaling kernel (1 - s) max(1 - f s, 0)^2, where s is the squared distance, pixels^2. A smaller f gives
// a longer and sharper kernel with more negative weights.
const PRESENT_WINDOW_FLAT = 0.5;
const PRESENT_WINDOW_EDGE = 0.35;
// Factors on the squared distance along an edge and across it.
const PRESENT_ALONG_EDGE = 0.25;
const PRESENT_ACROSS_EDGE = 1.44;
// Squared contrast below which nothing is an edge: noise from dithering.
const PRESENT_MIN_CONTRAST_2 = 1e-4;

// Weights of four pixels in the upscaling kernel.
fn present_weights(squared_distances: vec4f, window: f32) -> vec4f {
  let inside = max(1.0 - window * squared_distances, vec4f(0.0));
  return (1.0 - squared_distances) * inside * inside;
}

// Colour between the pixels of a smaller picture, in the manner of FSR 1 by AMD (Lottes, 2021): luma by a kernel of
// twelve pixels that is longer along an edge than across it, and sharper on edges than off them; never beyond the lumas
// of the four nearest pixels. Hue, in which the eye is less sharp, is interpolated linearly.
fn present_upscaled(uv: vec2f, size: vec2f) -> vec3f {
  let p = uv * size - 0.5;
  let corner = floor(p);
  let f = p - corner;
  // Lumas of four by four pixels. A gather has the lower left pixel of its four in x, then runs anticlockwise.
  let middle = (corner + 1.0) / size;
  let nw = textureGather(3, picture_map, picture_sampler, middle, vec2i(-1, -1));
  let ne = textureGather(3, picture_map, picture_sampler, middle, vec2i(1, -1));
  let sw = textureGather(3, picture_map, picture_sampler, middle, vec2i(-1, 1));
  let se = textureGather(3, picture_map, picture_sampler, middle, vec2i(1, 1));
  let near_colour = textureSampleLevel(picture_map, picture_sampler, uv, 0.0);
  let top = vec2f(nw.z, ne.w);
  let upper = vec4f(nw.xy, ne.xy);
  let lower = vec4f(sw.wz, se.wz);
  let bottom = vec2f(sw.y, se.x);

  let gradient = vec2f(
    mix(mix(upper.z - upper.x, upper.w - upper.y, f.x), mix(lower.z - lower.x, lower.w - lower.y, f.x), f.y),
    mix(mix(lower.y - top.x, lower.z - top.y, f.x), mix(bottom.x - upper.y, bottom.y - upper.z, f.x), f.y));
  let least = min(min(upper.y, upper.z), min(lower.y, lower.z));
  let most = max(max(upper.y, upper.z), max(lower.y, lower.z));
  let slope_2 = dot(gradient, gradient);
  // The gradient spans two pixels, so that squared it is four times the squared contrast on a straight edge.
  let contrast = 2.0 * (most - least);
  let scale = 1.0 / max(max(contrast * contrast, slope_2), PRESENT_MIN_CONTRAST_2);
  // How much of an edge there is, 0 to 1.
  let edge = slope_2 * scale;
  let window = PRESENT_WINDOW_FLAT - (PRESENT_WINDOW_FLAT - PRESENT_WINDOW_EDGE) * edge;

  // Squared distance of an offset (x, y): m.x x^2 + m.y x y + m.z y^2.
  let along = 1.0 - (1.0 - PRESENT_ALONG_EDGE) * edge;
  let g = gradient * ((PRESENT_ACROSS_EDGE - PRESENT_ALONG_EDGE) * scale);
  let m = vec3f(along + g.x * gradient.x, 2.0 * g.x * gradient.y, along + g.y * gradient.y);
  let x = vec4f(-1.0, 0.0, 1.0, 2.0) - f.x;
  let y = vec4f(-1.0, 0.0, 1.0, 2.0) - f.y;
  let xx = m.x * x * x;
  let xy = m.y * x;
  let yy = m.z * y * y;
  let ends = vec4f(y.xx, y.ww);
  let upper_weights = present_weights(xx + xy * y.y + yy.y, window);
  let lower_weights = present_weights(xx + xy * y.z + yy.z, window);
  let end_weights = present_weights(xx.yzyz + xy.yzyz * ends + vec4f(yy.xx, yy.ww), window);
  let sum = dot(upper_weights, upper) + dot(lower_weights, lower) + dot(end_weights, vec4f(top, bottom));
  let luma = clamp(sum / dot(upper_weights + lower_weights + end_weights, vec4f(1.0)), least, most);
  return near_colour.rgb + (luma - near_colour.a);
}

// Mean colour of the pixels of a larger picture in a pixel of the canvas, which is `ratio` pixels large: four bilinear
// samples in the middles of its quarters.
fn present_downscaled(uv: vec2f, ratio: vec2f, size: vec2f) -> vec3f {
  let quarter = 0.25 * ratio / size;
  let mirrored = vec2f(quarter.x, -quarter.y);
  let sum = textureSampleLevel(picture_map, picture_sampler, uv - quarter, 0.0).rgb
    + textureSampleLevel(picture_map, picture_sampler, uv + quarter, 0.0).rgb
    + textureSampleLevel(picture_map, picture_sampler, uv - mirrored, 0.0).rgb
    + textureSampleLevel(picture_map, picture_sampler, uv + mirrored, 0.0).rgb;
  return 0.25 * sum;
}

@fragment
fn fragment(in: ScreenVertex) -> @location(0) vec4f {
  let size = vec2f(textureDimensions(picture_map));
  // Pixels of the picture per pixel of the canvas.
  let ratio = fwidth(in.uv) * size;
  var colour: vec3f;
  if all(abs(ratio - 1.0) < vec2f(1e-3)) {
    colour = textureLoad(picture_map, vec2u(in.uv * size), 0).rgb;
  } else if max(ratio.x, ratio.y) > 1.0 {
    colour = present_downscaled(in.uv, ratio, size);
  } else {
    colour = present_upscaled(in.uv, size);
  }
  return vec4f(colour, 1.0);
}
