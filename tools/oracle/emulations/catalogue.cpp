#include "tools/oracle/emulations/catalogue.h"

#include <algorithm>

namespace strata::oracle {

std::span<const Mistake> catalogue() {
    static const std::vector<Mistake> all = [] {
        std::vector<Mistake> list;
        for (const auto part :
             {mistakes_of_samples(), mistakes_of_fixed_passes(), mistakes_of_reported_ports(), mistakes_of_steps(),
              mistakes_of_programs(), mistakes_of_device(), mistakes_of_scene(), mistakes_of_picture()})
            list.insert(list.end(), part.begin(), part.end());
        return list;
    }();
    return all;
}

const Mistake* find_mistake(std::string_view name) {
    const auto all = catalogue();
    const auto found = std::ranges::find(all, name, &Mistake::name);
    return found == all.end() ? nullptr : &*found;
}

}  // namespace strata::oracle
