#include "fascicle/anatomy/fibre_methods.hpp"

namespace fascicle {

const std::vector<FibreMethod>& fibre_methods() {
    static const std::vector<FibreMethod> methods{
        {"kukacka", "Template",
         "Isolines of a harmonic field between the attachments, onto which a template's cross-sections are "
         "mapped.",
         true, false, decompose_kukacka},
        {"chmd", "Superficial fibres",
         "Layers through the muscle's thickness below fibres digitised on its surface.", false, true,
         decompose_chmd},
        {"streamlines", "Streamlines",
         "Streamlines of a field that is harmonic in the muscle's volume between the attachments.", false,
         false, decompose_streamlines},
    };
    return methods;
}

} // namespace fascicle
