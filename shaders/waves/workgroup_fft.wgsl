// FFT for GPUs: both halves of the transform in one dispatch. RADIX_2 threads share a line. Thread t transforms the
// points n1 RADIX_2 + t in its registers, writes the results to workgroup memory, and transforms over n2 what it reads
// back.
// The row pass and the column pass each write out the exchange: as a shared function it takes 12 to 20 more registers
// on AMD's GCN 4 and RDNA 1.

override RADIX_1: u32 = 16u;
override RADIX_2: u32 = 16u;
override LINES_PER_WORKGROUP: u32 = 4u; // number of lines that a workgroup transforms
override EXCHANGE_VECTORS: u32 = 1024u; // vec4f in workgroup memory, LINES x N

var<private> fft_points: array<vec4f, 32>;
var<workgroup> fft_exchange: array<vec4f, EXCHANGE_VECTORS>;

// Multiplies point i by the twiddle factor re + i im.
fn fft_multiply_point(i: u32, re: f32, im: f32) {
  fft_points[i] = fft_complex_mul(fft_points[i], vec2f(re, im));
}

// Inverse FFT of two points in place.
fn fft_2(a: u32, b: u32) {
  let u = fft_points[a];
  let w = fft_points[b];
  fft_points[a] = u + w;
  fft_points[b] = u - w;
}

// Inverse FFT of four points in place, in natural order.
fn fft_4(a: u32, b: u32, c: u32, d: u32) {
  let s0 = fft_points[a] + fft_points[c];
  let s1 = fft_points[a] - fft_points[c];
  let s2 = fft_points[b] + fft_points[d];
  let e = fft_points[b] - fft_points[d];
  let s3 = vec4f(-e.y, e.x, -e.w, e.z);
  fft_points[a] = s0 + s2;
  fft_points[b] = s1 + s3;
  fft_points[c] = s0 - s2;
  fft_points[d] = s1 - s3;
}

const FFT_COS_1_8 = 0.70710678118654752; // cos(2 pi / 8)
const FFT_COS_1_16 = 0.92387953251128676; // cos(2 pi / 16)
const FFT_SIN_1_16 = 0.38268343236508977;
const FFT_COS_1_32 = 0.98078528040323045; // A: cos(2 pi k / 32), B: sin(2 pi k / 32) for k = 1 and 3
const FFT_SIN_1_32 = 0.19509032201612827;
const FFT_COS_3_32 = 0.83146961230254524;
const FFT_SIN_3_32 = 0.55557023301960222;

// Inverse FFT of eight points, from slot o on. The result X[k] ends in slot o + 2 (k % 4) + k / 4.
fn fft_8(o: u32) {
  fft_4(o, o + 2u, o + 4u, o + 6u);
  fft_4(o + 1u, o + 3u, o + 5u, o + 7u);
  fft_multiply_point(o + 3u, FFT_COS_1_8, FFT_COS_1_8);
  fft_multiply_point(o + 5u, 0.0, 1.0);
  fft_multiply_point(o + 7u, -FFT_COS_1_8, FFT_COS_1_8);
  fft_2(o, o + 1u);
  fft_2(o + 2u, o + 3u);
  fft_2(o + 4u, o + 5u);
  fft_2(o + 6u, o + 7u);
}

// Inverse FFT of sixteen points. The result X[k] ends in slot 4 (k % 4) + k / 4.
fn fft_16() {
  fft_4(0u, 4u, 8u, 12u);
  fft_4(1u, 5u, 9u, 13u);
  fft_4(2u, 6u, 10u, 14u);
  fft_4(3u, 7u, 11u, 15u);
  fft_multiply_point(5u, FFT_COS_1_16, FFT_SIN_1_16);
  fft_multiply_point(6u, FFT_COS_1_8, FFT_COS_1_8);
  fft_multiply_point(7u, FFT_SIN_1_16, FFT_COS_1_16);
  fft_multiply_point(9u, FFT_COS_1_8, FFT_COS_1_8);
  fft_multiply_point(10u, 0.0, 1.0);
  fft_multiply_point(11u, -FFT_COS_1_8, FFT_COS_1_8);
  fft_multiply_point(13u, FFT_SIN_1_16, FFT_COS_1_16);
  fft_multiply_point(14u, -FFT_COS_1_8, FFT_COS_1_8);
  fft_multiply_point(15u, -FFT_COS_1_16, -FFT_SIN_1_16);
  fft_4(0u, 1u, 2u, 3u);
  fft_4(4u, 5u, 6u, 7u);
  fft_4(8u, 9u, 10u, 11u);
  fft_4(12u, 13u, 14u, 15u);
}

// Inverse FFT of 32 points. The result X[k] ends in slot 8 (k % 4) + the slot of X[k / 4] in fft_8.
fn fft_32() {
  fft_4(0u, 8u, 16u, 24u);
  fft_4(1u, 9u, 17u, 25u);
  fft_4(2u, 10u, 18u, 26u);
  fft_4(3u, 11u, 19u, 27u);
  fft_4(4u, 12u, 20u, 28u);
  fft_4(5u, 13u, 21u, 29u);
  fft_4(6u, 14u, 22u, 30u);
  fft_4(7u, 15u, 23u, 31u);
  // Twiddle factors e^(2 pi i n2 k1 / 32) at slot n2 + 8 k1.
  fft_multiply_point(9u, FFT_COS_1_32, FFT_SIN_1_32);
  fft_multiply_point(10u, FFT_COS_1_16, FFT_SIN_1_16);
  fft_multiply_point(11u, FFT_COS_3_32, FFT_SIN_3_32);
  fft_multiply_point(12u, FFT_COS_1_8, FFT_COS_1_8);
  fft_multiply_point(13u, FFT_SIN_3_32, FFT_COS_3_32);
  fft_multiply_point(14u, FFT_SIN_1_16, FFT_COS_1_16);
  fft_multiply_point(15u, FFT_SIN_1_32, FFT_COS_1_32);
  fft_multiply_point(17u, FFT_COS_1_16, FFT_SIN_1_16);
  fft_multiply_point(18u, FFT_COS_1_8, FFT_COS_1_8);
  fft_multiply_point(19u, FFT_SIN_1_16, FFT_COS_1_16);
  fft_multiply_point(20u, 0.0, 1.0);
  fft_multiply_point(21u, -FFT_SIN_1_16, FFT_COS_1_16);
  fft_multiply_point(22u, -FFT_COS_1_8, FFT_COS_1_8);
  fft_multiply_point(23u, -FFT_COS_1_16, FFT_SIN_1_16);
  fft_multiply_point(25u, FFT_COS_3_32, FFT_SIN_3_32);
  fft_multiply_point(26u, FFT_SIN_1_16, FFT_COS_1_16);
  fft_multiply_point(27u, -FFT_SIN_1_32, FFT_COS_1_32);
  fft_multiply_point(28u, -FFT_COS_1_8, FFT_COS_1_8);
  fft_multiply_point(29u, -FFT_COS_1_32, FFT_SIN_1_32);
  fft_multiply_point(30u, -FFT_COS_1_16, -FFT_SIN_1_16);
  fft_multiply_point(31u, -FFT_SIN_3_32, -FFT_COS_3_32);
  fft_8(0u);
  fft_8(8u);
  fft_8(16u);
  fft_8(24u);
}

// Inverse FFT of 8, 16 or 32 points in fft_points.
fn fft_in_registers(size: u32) {
  if size == 32u {
    fft_32();
  } else if size == 16u {
    fft_16();
  } else {
    fft_8(0u);
  }
}

// Index in fft_points of the result X[k] of fft_in_registers.
fn fft_result_index(k: u32, size: u32) -> u32 {
  if size == 32u {
    return 8u * (k & 3u) + 2u * ((k >> 2u) & 3u) + (k >> 4u);
  }
  if size == 16u {
    return 4u * (k & 3u) + (k >> 2u);
  }
  return 2u * (k & 3u) + (k >> 2u);
}

// Index of the value (k1, n2) in a line's part of the workgroup memory: a permutation that avoids bank conflicts.
fn fft_exchange_index(k1: u32, n2: u32) -> u32 {
  return k1 * RADIX_2 + (n2 ^ (k1 & (RADIX_2 - 1u)));
}
