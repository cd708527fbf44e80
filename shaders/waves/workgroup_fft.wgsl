// FFT for GPUs: both halves of the transform in one dispatch. R2 threads share a line. Thread t transforms the points
// n1 R2 + t in its registers, writes the results to workgroup memory, and transforms over n2 what it reads back.

override R1: u32 = 16u;
override R2: u32 = 16u;
override LINES: u32 = 4u; // number of lines that a workgroup transforms
override EXCHANGE: u32 = 1024u; // vec4f in workgroup memory, LINES x N

var<private> fft_v: array<vec4f, 32>;
var<workgroup> fft_shared: array<vec4f, EXCHANGE>;

// Multiplies point i by the twiddle factor re + i im.
fn fft_twist(i: u32, re: f32, im: f32) {
  fft_v[i] = fft_mul(fft_v[i], vec2f(re, im));
}

// Inverse FFT of two points in place.
fn fft_2(a: u32, b: u32) {
  let u = fft_v[a];
  let w = fft_v[b];
  fft_v[a] = u + w;
  fft_v[b] = u - w;
}

// Inverse FFT of four points in place, in natural order.
fn fft_4(a: u32, b: u32, c: u32, d: u32) {
  let s0 = fft_v[a] + fft_v[c];
  let s1 = fft_v[a] - fft_v[c];
  let s2 = fft_v[b] + fft_v[d];
  let e = fft_v[b] - fft_v[d];
  let s3 = vec4f(-e.y, e.x, -e.w, e.z);
  fft_v[a] = s0 + s2;
  fft_v[b] = s1 + s3;
  fft_v[c] = s0 - s2;
  fft_v[d] = s1 - s3;
}

const FFT_H = 0.70710678118654752; // cos(2 pi / 8)
const FFT_C1 = 0.92387953251128676; // cos(2 pi / 16)
const FFT_S1 = 0.38268343236508977;
const FFT_A1 = 0.98078528040323045; // A: cos(2 pi k / 32), B: sin(2 pi k / 32) for k = 1 and 3
const FFT_B1 = 0.19509032201612827;
const FFT_A3 = 0.83146961230254524;
const FFT_B3 = 0.55557023301960222;

// Inverse FFT of eight points, from slot o on. The result X[k] ends in slot o + 2 (k % 4) + k / 4.
fn fft_8(o: u32) {
  fft_4(o, o + 2u, o + 4u, o + 6u);
  fft_4(o + 1u, o + 3u, o + 5u, o + 7u);
  fft_twist(o + 3u, FFT_H, FFT_H);
  fft_twist(o + 5u, 0.0, 1.0);
  fft_twist(o + 7u, -FFT_H, FFT_H);
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
  fft_twist(5u, FFT_C1, FFT_S1);
  fft_twist(6u, FFT_H, FFT_H);
  fft_twist(7u, FFT_S1, FFT_C1);
  fft_twist(9u, FFT_H, FFT_H);
  fft_twist(10u, 0.0, 1.0);
  fft_twist(11u, -FFT_H, FFT_H);
  fft_twist(13u, FFT_S1, FFT_C1);
  fft_twist(14u, -FFT_H, FFT_H);
  fft_twist(15u, -FFT_C1, -FFT_S1);
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
  fft_twist(9u, FFT_A1, FFT_B1);
  fft_twist(10u, FFT_C1, FFT_S1);
  fft_twist(11u, FFT_A3, FFT_B3);
  fft_twist(12u, FFT_H, FFT_H);
  fft_twist(13u, FFT_B3, FFT_A3);
  fft_twist(14u, FFT_S1, FFT_C1);
  fft_twist(15u, FFT_B1, FFT_A1);
  fft_twist(17u, FFT_C1, FFT_S1);
  fft_twist(18u, FFT_H, FFT_H);
  fft_twist(19u, FFT_S1, FFT_C1);
  fft_twist(20u, 0.0, 1.0);
  fft_twist(21u, -FFT_S1, FFT_C1);
  fft_twist(22u, -FFT_H, FFT_H);
  fft_twist(23u, -FFT_C1, FFT_S1);
  fft_twist(25u, FFT_A3, FFT_B3);
  fft_twist(26u, FFT_S1, FFT_C1);
  fft_twist(27u, -FFT_B1, FFT_A1);
  fft_twist(28u, -FFT_H, FFT_H);
  fft_twist(29u, -FFT_A1, FFT_B1);
  fft_twist(30u, -FFT_C1, -FFT_S1);
  fft_twist(31u, -FFT_B3, -FFT_A3);
  fft_8(0u);
  fft_8(8u);
  fft_8(16u);
  fft_8(24u);
}

// Inverse FFT of 8, 16 or 32 points in fft_v.
fn fft_registers(size: u32) {
  if size == 32u {
    fft_32();
  } else if size == 16u {
    fft_16();
  } else {
    fft_8(0u);
  }
}

// Index in fft_v of the result X[k] of fft_registers.
fn fft_slot(k: u32, size: u32) -> u32 {
  if size == 32u {
    return 8u * (k & 3u) + 2u * ((k >> 2u) & 3u) + (k >> 4u);
  }
  if size == 16u {
    return 4u * (k & 3u) + (k >> 2u);
  }
  return 2u * (k & 3u) + (k >> 2u);
}

// Index of the value (k1, n2) in a line's part of the workgroup memory: a permutation that avoids bank conflicts.
fn fft_place(k1: u32, n2: u32) -> u32 {
  return k1 * R2 + (n2 ^ (k1 & (R2 - 1u)));
}

// First half of the transform for thread t of a line: from the points n1 R2 + t in fft_v to the line's part of the
// workgroup memory, which begins at `exchange`.
fn fft_first(t: u32, exchange: u32) {
  fft_registers(R1);
  workgroupBarrier();
  for (var k1 = 0u; k1 < R1; k1++) {
    let w = twiddle[t * k1 * (1024u / N)];
    fft_shared[exchange + fft_place(k1, t)] = fft_mul(fft_v[fft_slot(k1, R1)], w);
  }
  workgroupBarrier();
}

// Second half: leaves the result X[k1 + R1 k2] in slot fft_slot(k2, R2) of fft_v.
fn fft_second(k1: u32, exchange: u32) {
  for (var n2 = 0u; n2 < R2; n2++) {
    fft_v[n2] = fft_shared[exchange + fft_place(k1, n2)];
  }
  fft_registers(R2);
}
