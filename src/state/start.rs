//! The sea that the page and the window open with when no state string says which.

/// State string of the first sea: a fresh breeze on a long swell, a low sun beside cirrus, and a yacht for scale.
pub const START: &str = "v=2&wind=8&fetch=60&dir=150&scale2=1&hs2=1.8&swell2=0.8&sun=18&sunaz=5&haze=0.2\
    &clouds=cirrus&cloudcover=0.3&glints=1&gusts=1&bloom=0.06&localexposure=0.5&y=3.5&heading=330&pitch=4&fov=45&t=42\
    &afloat=yacht*-40*-90";

/// State string of the default parameters for a link, because a link without a state string opens [`START`].
pub const DEFAULT_SEA: &str = "v=2";

/// The state string to open for `given`, the query of the page's address or the window's argument: [`START`] if it is
/// empty.
pub fn given_or_start(given: &str) -> &str {
    if given.is_empty() { START } else { given }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::{Params, query};

    #[test]
    fn the_first_sea_is_as_a_link_would_write_it() {
        let (params, notices) = query::parse(&format!("?{START}"));
        assert!(notices.is_empty(), "{notices:?}");
        assert_eq!(query::write_to_keep(&params), START);
    }

    #[test]
    fn the_default_sea_can_be_linked() {
        assert_eq!(query::parse(&format!("?{DEFAULT_SEA}")), (Params::default(), Vec::new()));
    }
}
