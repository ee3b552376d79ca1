// tools/oracle/program/fit/curves.cpp - fits several parameters at once: a background, a matrix, a curve, weights
// (search.h).
#include <algorithm>
#include <cmath>

#include "tools/oracle/program/fit/search.h"

namespace strata::oracle::program {

namespace {

using Vector = std::vector<double>;

}  // namespace

Vector solved(std::vector<Vector> a, Vector b) {
    const std::size_t n = b.size();
    for (std::size_t i = 0; i < n; ++i) {
        a[i][i] = std::max(a[i][i], 1e-30);
        for (std::size_t j = i + 1; j < n; ++j) {
            const double factor = a[j][i] / a[i][i];
            for (std::size_t k = i; k < n; ++k) a[j][k] -= factor * a[i][k];
            b[j] -= factor * b[i];
        }
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[i][k] * b[k];
        b[i] /= a[i][i];
    }
    return b;
}

namespace {

class GaussNewton {
  public:
    GaussNewton(const FitSample& sample, const Edit& edit)
        : sample_{sample}, entry_{*edit.entry}, mask_{sample.mask(*edit.entry, edit.conditions)} {}

    // One step, damped until it gains something. Returns false if nothing does.
    bool step(Vector& p) const {
        const std::size_t n = p.size();
        const Vector r = residuals(p);
        std::vector<Vector> a(n, Vector(n, 0));
        Vector b(n, 0);
        add_equations(p, r, a, b);
        for (double damping = 1e-6; damping < 1e4; damping *= 30) {
            std::vector<Vector> damped = a;
            for (std::size_t j = 0; j < n; ++j) damped[j][j] += damping * (a[j][j] + 1e-9);
            const Vector by = solved(damped, b);
            Vector next = p;
            for (std::size_t j = 0; j < n; ++j) next[j] -= by[j];
            if (cost(residuals(next)) < cost(r) * (1 - 1e-6)) {
                p = next;
                return true;
            }
        }
        return false;
    }

  private:
    // Of each channel of each pixel, in codes.
    [[nodiscard]] Vector residuals(const Vector& p) const {
        Vector all;
        for (std::size_t i = 0; i < sample_.pixels().size(); ++i) {
            const SamplePixel& pixel = sample_.pixels()[i];
            const Color color = sample_.exact(pixel, entry_, p, sample_.mask_at(i, entry_.step, mask_));
            for (const double r : residual(color, *pixel.pixel, sample_.unit())) all.push_back(r);
        }
        return all;
    }
    [[nodiscard]] double weight_at(std::size_t residual) const { return sample_.pixels()[residual / 3].weight; }
    [[nodiscard]] double cost(const Vector& r) const {
        double sum = 0;
        for (std::size_t i = 0; i < r.size(); ++i) sum += weight_at(i) * std::log1p(r[i] * r[i] / 9);
        return sum;
    }
    void add_equations(const Vector& p, const Vector& r, std::vector<Vector>& a, Vector& b) const {
        constexpr double small = 1e-5;
        std::vector<Vector> slopes;
        for (std::size_t j = 0; j < p.size(); ++j) {
            Vector moved = p;
            moved[j] += small;
            Vector& slope = slopes.emplace_back(residuals(moved));
            for (std::size_t i = 0; i < r.size(); ++i) slope[i] = (slope[i] - r[i]) / small;
        }
        for (std::size_t i = 0; i < r.size(); ++i)
            for (std::size_t j = 0; j < p.size(); ++j) {
                const double w = weight_at(i) / (1 + r[i] * r[i] / 9) * slopes[j][i];
                b[j] += w * r[i];
                for (std::size_t k = 0; k < p.size(); ++k) a[j][k] += w * slopes[k][i];
            }
    }

    const FitSample& sample_;
    const StepEntry& entry_;
    std::vector<char> mask_;
};

}  // namespace

void fit_parameters(Scorer& scorer, Trial& trial) {
    Edit edit = trial.edit;
    const GaussNewton fit{scorer.sample(), edit};
    constexpr int most_steps = 20;
    for (int i = 0; i < most_steps && fit.step(edit.parameters); ++i) {
    }
    trial = {edit, scorer(edit)};
    for (const double scale : {20.0, 100.0, 1000.0}) {
        Edit rounded = edit;
        for (double& p : rounded.parameters) p = std::nearbyint(p * scale) / scale;
        if (const double cost = scorer(rounded); cost <= trial.cost * 1.02 + 1) {
            trial = {rounded, cost};
            break;
        }
    }
}

}  // namespace strata::oracle::program
