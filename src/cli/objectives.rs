//! The list of objectives (sections 1.10.1 to 1.10.3 of its text), and the parameters that answer it.

/// Number, objective, keys that answer it, and how it is met.
pub type Objective = (&'static str, &'static str, &'static [&'static str], &'static str);

/// Keys that are named below before they have a row in FIELDS; they are left out of the page until they have.
#[rustfmt::skip]
pub const AWAITED: &[&str] = &[
    // The water's material.
    "water", "watermix", "scattercolour", "bubblecolour", "bubbles", "heightscatter", "viewscatter", "diffuse",
    "ambient", "reflection", "nwater", "nair", "fresnel", "fresnelshine", "fresnelscale", "fresnelnormals",
    "specular", "shininess", "glitter", "glitterfresnel", "glittercut", "roughness", "foamcolour",
    "foamroughness",
];

/// Keys of the state string that are no numbers, and so no rows of FIELDS.
pub const OUTSIDE: &[&str] = &["measured", "sky"];

/// Sections of the list.
pub const SECTIONS: &[(&str, &[Objective])] =
    &[("1.10.1 Engine", ENGINE), ("1.10.2 Simulation", SIMULATION), ("1.10.3 Renderer", RENDERER)];

#[rustfmt::skip]
const ENGINE: &[Objective] = &[
    ("1", "a window", &[], "the desktop program opens one; the page fills its tab"),
    ("1.1", "title", &[], "Seastate"),
    ("1.2", "the system's conventions", &[], "the window is the system's own (winit)"),
    ("1.3", "resizing", &[], "the picture is made anew in the new size; the sea does not notice"),
    ("1.4", "moving", &[], "the window is the system's own"),
    ("1.5", "moving between monitors", &[], "the same, with each monitor's own pixel density"),
    ("1.6", "closed by Escape", &[], "on the desktop; a view returns to the picture first"),
    ("2", "a single mesh", &[], "one lattice around the eye: its index buffer is made on the CPU, its vertices in the shader"),
    ("2.1", "mesh size", &["mesh", "extent"], "density and reach; they stand for the size of a tile"),
    ("2.2", "several instances", &[], "one mesh reaches past the horizon instead, without seams"),
    ("2.3", "number of instances", &["extent"], "how far the one mesh reaches"),
    ("3", "a skybox from a file", &["sky", "skyturn", "skygain"], "the sky is computed; one from a file can stand in its place"),
    ("4", "camera control", &["x", "y", "z", "heading", "pitch", "fov"], "and WASD, arrows, Q and E fly"),
    ("4.1", "only with the left button held", &[], "dragging turns the camera"),
    ("4.2", "pitch", &["pitch"], "drag"),
    ("4.3", "yaw", &["heading"], "drag"),
    ("4.4", "zoom", &["fov"], "wheel or pinch"),
    ("4.5", "render distance", &["extent"], "to the horizon of the round Earth"),
    ("4.6", "field of view kept on resizing", &["fov"], "it is vertical, and a parameter"),
    ("4.7", "direction kept on resizing", &["heading", "pitch"], "parameters, which a window does not change"),
    ("5", "camera only outside the interface", &[], "what happens on the panel never reaches the camera"),
    ("6", "an interface", &[], "the panel; every key of the state string is in it"),
    ("6.1", "resized", &[], "at its corner"),
    ("6.2", "moved", &[], "by its title"),
    ("6.3", "collapsed", &[], "by its triangle"),
    ("6.4", "colours edited", &["suncolour", "scattercolour", "bubblecolour", "foamcolour"], "with a colour picker"),
    ("6.5", "sliders", &[], "every number has one"),
    ("6.6", "frames a second", &[], "under This program"),
    ("6.7", "resolution of the simulation", &["n", "cascades"], "under This program"),
    ("6.8", "time elapsed", &["t"], "beside the Pause button"),
];

#[rustfmt::skip]
const SIMULATION: &[Objective] = &[
    ("1", "Gaussian variance", &["seed"], "xi_r, xi_i are standard normal; measured over 64 seeds"),
    ("2", "more than 60 frames a second", &["n", "mesh"], "two dispatches for the waves of all cascades; `seastate bench` and docs/performance.md"),
    ("3", "sensible defaults", &[], "an open sea at 12 m/s over 150 km; docs/validation.md"),
    ("4", "parameters clamped", &[], "every value is clamped to its range with a notice; 100,000 hostile strings are tested"),
    ("5", "no visible tiling", &["untile"], "patches share no period"),
    ("6", "three length scales", &["cascades"], "one to four"),
    ("6.1", "length scales", &["patch1", "patch2", "patch3", "patch4"], ""),
    ("6.2", "low cut-offs", &["low1", "low2", "low3", "low4"], ""),
    ("6.3", "high cut-offs", &["high1", "high2", "high3", "high4"], ""),
    ("7", "controllable size", &["mesh", "extent", "n"], ""),
    ("7.1", "tile size", &["mesh", "extent"], "one mesh instead of tiles: its density and reach"),
    ("7.2", "instances", &["extent"], "one mesh instead of instances"),
    ("7.3", "resolution of the simulation", &["n"], ""),
    ("8", "foam", &["whitecaps"], ""),
    ("8.1", "colour", &["foamcolour"], ""),
    ("8.2", "decay", &["foamdecay"], ""),
    ("8.3", "how much is visible", &["foam"], ""),
    ("8.4", "when it is injected", &["whitecaps", "foamthreshold", "foambias"], ""),
    ("8.5", "how much is injected", &["foamrate"], ""),
    ("9", "ocean conditions", &["spectrum", "spread"], "and a second system, the same keys with a 2"),
    ("9.1", "depth", &["depth"], ""),
    ("9.2", "gravity", &["g"], ""),
    ("9.3", "wind speed", &["wind"], ""),
    ("9.4", "wind angle", &["dir"], "where it comes from"),
    ("9.5", "fetch", &["fetch"], ""),
    ("9.6", "choppiness", &["chop", "chopx", "chopz"], ""),
    ("9.7", "amount of swell", &["swell", "scale2"], "narrower directions, or a second system"),
    ("9.8", "integration step of swell", &["normsteps"], ""),
    ("9.9", "height offset", &["level"], ""),
];

#[rustfmt::skip]
const RENDERER: &[Objective] = &[
    ("1", "a skybox", &["sky"], "a physically based sky, or one from a file"),
    ("1.1", "turns with the view", &[], "a ray for every pixel"),
    ("1.2", "follows the zoom", &[], "the same"),
    ("1.3", "follows the window", &[], "the same"),
    ("1.4", "a sun in it", &["sun", "sunaz"], ""),
    ("1.4.1", "where the light comes from", &["sun", "sunaz"], "one direction for disc, light and glitter"),
    ("1.4.2", "follows the view", &[], "a ray for every pixel"),
    ("1.4.3", "follows the zoom", &[], "the same"),
    ("1.4.4", "follows the window", &[], "the same"),
    ("1.4.5", "sun parameters", &["sunby", "day", "hour", "lat"], "by direction, or by date, hour and latitude"),
    ("1.4.5.1", "colour", &["suncolour", "haze"], ""),
    ("1.4.5.2", "x direction", &["sunaz", "sun"], "azimuth and height hold the three components of a unit vector"),
    ("1.4.5.3", "y direction", &["sun"], "the same"),
    ("1.4.5.4", "z direction", &["sunaz", "sun"], "the same"),
    ("1.4.5.5", "angle", &["sun"], ""),
    ("1.4.5.6", "distance", &["sundistance"], ""),
    ("1.4.5.7", "size", &["sunsize"], ""),
    ("1.4.5.8", "falloff", &["sunfalloff"], ""),
    ("2", "displacement without pixelation", &[], "interpolated, filtered to the spacing of the mesh"),
    ("3", "normals without pixelation", &[], "gradients of the waves themselves, filtered to the pixel"),
    ("4", "foam without pixelation", &[], "four levels around the camera, and grain close by"),
    ("5", "subsurface scattering", &["water", "watermix"], ""),
    ("5.1", "scatter colour", &["scattercolour"], ""),
    ("5.2", "bubble colour", &["bubblecolour"], ""),
    ("5.3", "bubble density", &["bubbles"], ""),
    ("5.4", "height attenuation", &["heightscatter"], ""),
    ("5.5", "reflection strength", &["viewscatter"], ""),
    ("5.6", "diffuse strength", &["diffuse"], ""),
    ("5.7", "ambient strength", &["ambient"], ""),
    ("6", "reflections of the environment", &[], "summed over the slopes that the eye sees"),
    ("6.1", "strength", &["reflection"], ""),
    ("6.2", "Fresnel", &["fresnel"], ""),
    ("6.2.1", "index of water", &["nwater"], ""),
    ("6.2.2", "index of air", &["nair"], ""),
    ("6.2.3", "shine", &["fresnelshine"], ""),
    ("6.2.4", "scale", &["fresnelscale"], ""),
    ("6.2.5", "normals scale", &["fresnelnormals"], ""),
    ("7", "specular that is not physical", &["specular"], "blinn-phong"),
    ("7.1", "toggle", &["specular"], ""),
    ("7.2", "shininess", &["shininess"], ""),
    ("8", "physical specular", &["specular"], "gaussian or ggx"),
    ("8.1", "scale", &["glitter"], ""),
    ("8.2", "Fresnel scale", &["glitterfresnel"], ""),
    ("8.3", "low cut-off", &["glittercut"], ""),
    ("8.4", "roughness of water", &["roughness"], ""),
    ("8.5", "roughness of foam", &["foamroughness"], ""),
    ("9", "distance fog", &["haze", "fog"], ""),
    ("9.1", "density", &["fog"], ""),
    ("9.2", "distance offset", &["fogstart"], ""),
    ("9.3", "falloff", &["fogfalloff"], ""),
    ("9.4", "height offset", &["fogheight"], ""),
];
