// tools/oracle/rounding/storage_rounding.cpp - derives the numbers of a rounding from the hypothesis
// (storage_rounding.h).
#include "tools/oracle/rounding/storage_rounding.h"

namespace strata::oracle::verdict {

namespace {

double scale_of(Storage storage) noexcept {
    switch (storage) {
        case Storage::unorm8: return 255;
        case Storage::unorm10: return 1023;
        case Storage::unorm16: return 65535;
        case Storage::half:
        case Storage::single: break;
    }
    return 0;
}

// Rounds to halves exactly, not by their relative error.
StorageRounding to_halves(StorageRounding k, bool truncates) noexcept {
    k.half = truncates ? StorageRounding::Half::truncated : StorageRounding::Half::nearest;
    k.relative = single_error;
    return k;
}

}  // namespace

StorageRounding few_bits(std::uint8_t bits, Rounding rounding) noexcept {
    StorageRounding k{.scale = std::exp2(bits) - 1};
    k.inverse = 1 / k.scale;
    k.truncates = rounding == Rounding::truncated;
    k.minus = k.plus = rounding == Rounding::any ? 1 : 0.5 + k.scale * single_error;
    k.truncation_low = -k.scale * single_error;
    k.truncation_high = k.scale * single_error;
    return k;
}

bool has_stored_source(SourceRounding source) noexcept {
    return source == SourceRounding::stored || source == SourceRounding::stored_either_way ||
           source == SourceRounding::premultiplied || source == SourceRounding::premultiplied_either_way ||
           source == SourceRounding::premultiplied_truncated;
}

StorageRounding keeper(Storage storage, Rounding rounding, bool operands_are_codes) {
    StorageRounding k;
    k.scale = scale_of(storage);
    k.has_codes = k.scale > 0;
    if (!k.has_codes) {
        const bool truncates = rounding == Rounding::truncated || rounding == Rounding::any;
        k.relative = storage == Storage::half ? (truncates ? 0x1p-10 : 0x1p-11) : (truncates ? 0x1p-23 : 0x1p-24);
        k.relative += single_error;
        k.least = storage == Storage::half ? 0x1p-24 : 0x1p-120;  // covers subnormals, flushed or not
        return storage == Storage::half && rounding == Rounding::truncated ? to_halves(k, true) : k;
    }
    k.inverse = 1 / k.scale;
    // The error of a quotient of codes is less than half of the least distance between two such quotients; that of a
    // blend in binary32 is single_error.
    const double error = operands_are_codes ? 0x1p-30 : k.scale * single_error;
    switch (rounding) {
        case Rounding::nearest: k.minus = k.plus = 0.5 + error; break;
        case Rounding::products: k.minus = k.plus = 0.5 + 1.0 / 64 + error; break;  // blend_unorm8.h: product()
        case Rounding::held:
        case Rounding::held_then_nearest:
            k.minus = k.plus = 0.5 + error;
            k.snaps = false;
            break;
        case Rounding::any:
            k.minus = k.plus = 2 * (0.5 + 1.0 / 64 + error);  // as for two rounded products
            k.snaps = false;
            break;
        case Rounding::truncated:
            k.truncates = true;
            k.truncation_low = operands_are_codes ? 0.25 / k.scale : -error;
            k.truncation_high = operands_are_codes ? 0.25 / k.scale : error;
            break;
    }
    return k;
}

StorageRounding storing(const End& result, bool is_divided) {
    StorageRounding k = keeper(result.storage, result.rounding, false);
    if (is_divided) {
        constexpr double of_product = 1 + 1.0 / 255;
        k.minus += of_product;
        k.plus += of_product;
        k.truncation_low -= of_product;
        k.truncation_high += of_product;
        k.relative *= 4;
        return k;
    }
    const bool is_known = result.rounding == Rounding::nearest || result.rounding == Rounding::truncated;
    if (result.storage != Storage::half || !is_known) return k;
    return to_halves(k, result.rounding == Rounding::truncated);
}

StorageRounding conversion(const End& end) {
    const auto [storage, source, rounding] = end;
    if (storage == Storage::half) return keeper(storage, rounding, false);
    if (const auto of_layers = layer_storage(source)) {
        const StorageRounding k = keeper(*of_layers, Rounding::nearest, false);
        return *of_layers == Storage::half ? to_halves(k, false) : k;
    }
    if (source == SourceRounding::any) return keeper(storage, Rounding::any, false);
    if (source == SourceRounding::premultiplied_truncated) return keeper(storage, Rounding::truncated, false);
    const bool goes_up = source == SourceRounding::stored || source == SourceRounding::premultiplied;
    return keeper(storage, Rounding::nearest, goes_up);
}

}  // namespace strata::oracle::verdict
