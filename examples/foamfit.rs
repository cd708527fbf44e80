use half::f16;
use seastate::gpu::{device::Gpu, readback, shaders::Shaders};
use seastate::model::{Plan, foam::Whiteness, query, statistics};
use seastate::sim::{MAX_STEPS, Simulation};
fn main() {
    let gpu = pollster::block_on(Gpu::request()).unwrap();
    for more in ["", "&foamrate=0.5&foamdecay=2", "&foamrate=5&foamdecay=10"] {
        for (wind, fetch) in [(5.0, 50.0), (7.0, 100.0), (10.0, 200.0), (14.0, 300.0), (20.0, 500.0), (30.0, 1000.0)] {
            let mut sums = vec![0.0; 4];
            let mut src = vec![0.0; 4];
            let mut cov = 0.0;
            let mut tm = 0.0;
            let times = [5.0, 40.0, 77.0];
            for t in times {
                let p = query::parse(&format!("wind={wind}&fetch={fetch}&n=128&t={t}{more}")).0;
                let plan = Plan::new(&p);
                cov = Whiteness::new(&plan).coverage;
                tm = statistics::Theory::new(&plan).tp_s;
                let mut sim = Simulation::new(&gpu.device, &gpu.queue, plan, &Shaders::default());
                let mut e = gpu.device.create_command_encoder(&Default::default());
                sim.encode(&gpu.queue, &mut e, t, [0.0; 2], MAX_STEPS);
                let copy = readback::stage_texture(&gpu.device, &mut e, &sim.resources.foam, 0);
                gpu.queue.submit([e.finish()]);
                let bytes = pollster::block_on(copy.read(&gpu.device)).unwrap();
                let texels: Vec<[f16; 4]> = bytemuck::pod_collect_to_vec(&bytes);
                let size = sim.resources.foam_n as usize;
                for (i, level) in texels.chunks(size * size).enumerate() {
                    sums[i] += level.iter().map(|t| t[0].to_f64()).sum::<f64>() / level.len() as f64 / 3.0;
                    src[i] += level.iter().map(|t| t[1].to_f64()).sum::<f64>() / level.len() as f64 / 3.0;
                }
            }
            let w = statistics::monahan_coverage(wind);
            println!(
                "{more} wind {wind} Tp {tm:.1} W {w:.5} guess {cov:.5} cover/W {:?} source/(W/2.8) {:?} gain {:?}",
                sums.iter().map(|s| format!("{:.2}", s / w)).collect::<Vec<_>>(),
                src.iter().map(|s| format!("{:.2}", s / w * 2.8)).collect::<Vec<_>>(),
                sums.iter().zip(&src).map(|(s, q)| format!("{:.2}", s / q)).collect::<Vec<_>>()
            );
        }
    }
}
