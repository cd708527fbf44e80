// Inverse FFT for GPUs: a whole line in one dispatch. N / 4 threads share a line, with four points each. In Stockham's
// form, each stage does FFTs of four points in registers; between two stages the threads exchange their points through
// workgroup memory. If N is not a power of 4, the first stage does FFTs of two points.
// A thread needs few registers and 64 bytes of workgroup memory, so many workgroups run on a GPU at a time.

override THREADS_PER_LINE: u32 = 64u; // N / 4
override LINES_PER_WORKGROUP: u32 = 1u; // number of lines that a workgroup transforms
override EXCHANGE_VECTORS: u32 = 256u; // vec4f in workgroup memory, LINES_PER_WORKGROUP x N

var<workgroup> fft_exchange: array<vec4f, EXCHANGE_VECTORS>;

// The points t, t + N / 4, t + N / 2 and t + 3 N / 4 of a line, which thread t holds.
struct FftPoints {
  a: vec4f,
  b: vec4f,
  c: vec4f,
  d: vec4f,
}

// Inverse FFT of four points, in natural order.
fn fft_4(p: FftPoints) -> FftPoints {
  let s0 = p.a + p.c;
  let s1 = p.a - p.c;
  let s2 = p.b + p.d;
  let e = p.b - p.d;
  let s3 = vec4f(-e.y, e.x, -e.w, e.z);
  return FftPoints(s0 + s2, s1 + s3, s0 - s2, s1 - s3);
}

// Where point i of a line lies among the line's places in workgroup memory: a permutation, by which neighbouring threads
// use different banks.
fn fft_place(i: u32) -> u32 {
  return i ^ ((i >> 2u) & 7u);
}

// The points of thread t, after all threads of the line have written theirs. Point i of the line lies at
// base + stride x fft_place(i).
fn fft_read_exchange(t: u32, base: u32, stride: u32) -> FftPoints {
  workgroupBarrier();
  let p = FftPoints(
    fft_exchange[base + stride * fft_place(t)],
    fft_exchange[base + stride * fft_place(t + N / 4u)],
    fft_exchange[base + stride * fft_place(t + N / 2u)],
    fft_exchange[base + stride * fft_place(t + N / 4u * 3u)]);
  workgroupBarrier();
  return p;
}

// Inverse FFT of the line whose points the threads hold. `base` and `stride` place the line in workgroup memory.
fn fft_line(points: FftPoints, t: u32, base: u32, stride: u32) -> FftPoints {
  var p = points;
  var done = 1u; // number of points of the FFTs that the stages so far have completed
  if (N & 0x55555555u) == 0u {
    fft_exchange[base + stride * fft_place(2u * t)] = p.a + p.c;
    fft_exchange[base + stride * fft_place(2u * t + 1u)] = p.a - p.c;
    fft_exchange[base + stride * fft_place(2u * t + N / 2u)] = p.b + p.d;
    fft_exchange[base + stride * fft_place(2u * t + N / 2u + 1u)] = p.b - p.d;
    p = fft_read_exchange(t, base, stride);
    done = 2u;
  }
  while done < N {
    let j = t & (done - 1u);
    // Twiddle factors e^(2 pi i j k / (4 done)) for k = 1, 2 and 3.
    let step = j * (256u / done);
    p.b = fft_complex_mul(p.b, twiddle_factors[step]);
    p.c = fft_complex_mul(p.c, twiddle_factors[2u * step]);
    p.d = fft_complex_mul(p.d, twiddle_factors[3u * step]);
    p = fft_4(p);
    if done < N / 4u {
      let first = 4u * (t - j) + j;
      fft_exchange[base + stride * fft_place(first)] = p.a;
      fft_exchange[base + stride * fft_place(first + done)] = p.b;
      fft_exchange[base + stride * fft_place(first + 2u * done)] = p.c;
      fft_exchange[base + stride * fft_place(first + 3u * done)] = p.d;
      p = fft_read_exchange(t, base, stride);
    }
    done *= 4u;
  }
  return p;
}
