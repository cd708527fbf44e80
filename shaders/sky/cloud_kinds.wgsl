// Numbers of the kinds of clouds, as in the parameter `clouds`.
const CLOUD_CUMULUS = 1u;
const CLOUD_STRATOCUMULUS = 2u;
const CLOUD_TOWERING = 3u;
const CLOUD_CIRRUS = 4u;
const CLOUD_STORM = 5u;
