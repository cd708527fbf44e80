//! Estimates from an ensemble: a value with its standard error.

/// An estimate from an ensemble, such as a mean over seeds: a value and its standard error.
#[derive(Clone, Copy, Debug)]
pub struct EstimateWithError {
    /// The estimated value.
    pub value: f64,
    /// Standard error of the value; `None` if the ensemble has a single member.
    pub standard_error: Option<f64>,
}

impl EstimateWithError {
    /// Estimates the mean of `values`, one for each member of an ensemble, with its standard error.
    pub fn mean(values: &[f64]) -> Self {
        let count = values.len() as f64;
        let value = values.iter().sum::<f64>() / count;
        let squares = values.iter().map(|v| (v - value).powi(2)).sum::<f64>();
        Self { value, standard_error: (values.len() > 1).then(|| (squares / (count - 1.0) / count).sqrt()) }
    }

    /// Estimates the mean of `numerator` divided by the mean of `denominator`, with one value of each per member of the
    /// ensemble. The standard error is that of the linearised ratio. The ratio is 0 if the denominator's mean is 0.
    pub fn ratio(numerator: &[f64], denominator: &[f64]) -> Self {
        let mean = denominator.iter().sum::<f64>() / denominator.len() as f64;
        if mean == 0.0 {
            return Self { value: 0.0, standard_error: None };
        }
        let value = numerator.iter().sum::<f64>() / denominator.len() as f64 / mean;
        let residuals: Vec<f64> = numerator.iter().zip(denominator).map(|(a, b)| (a - value * b) / mean).collect();
        Self { value, standard_error: Self::mean(&residuals).standard_error }
    }

    /// Estimates a statistic of an ensemble of `count` members, with its jackknife error. `statistic` computes it
    /// without the member of the given index, or from all members if it gets `None`.
    pub fn jackknife(count: usize, statistic: impl Fn(Option<usize>) -> f64) -> Self {
        let replicates: Vec<f64> = (0..count).map(|i| statistic(Some(i))).collect();
        let error = Self::mean(&replicates).standard_error.map(|e| e * (count as f64 - 1.0));
        Self { value: statistic(None), standard_error: error }
    }

    /// The estimate times a factor: the value times `factor`, and the standard error times its magnitude.
    pub fn scaled(self, factor: f64) -> Self {
        self.with_propagated_error(factor * self.value, factor)
    }

    /// Estimate of a function of this estimate. `value` and `derivative` are the function's value and derivative at
    /// this estimate's value; the standard error is multiplied by the magnitude of `derivative`.
    pub fn with_propagated_error(self, value: f64, derivative: f64) -> Self {
        Self { value, standard_error: self.standard_error.map(|e| e * derivative.abs()) }
    }

    /// The estimate as a point of a figure: x, the value and its standard error (0 for a single member).
    pub fn x_value_error(self, x: f64) -> [f64; 3] {
        [x, self.value, self.standard_error.unwrap_or(0.0)]
    }
}
