#include "reproduce/experiment.hpp"

namespace fascicle::reproduce {

namespace {

using view::StandardView;

/// A muscle of the right hip between pelvis and femur.
Experiment hip(const char* key, const char* title, const char* figures, const char* muscle) {
    Experiment e;
    e.key = key;
    e.title = title;
    e.figures = figures;
    e.muscle = muscle;
    e.muscle_file = e.muscle + ".vtk";
    e.fixed_bones = {"pelvis.obj"};
    e.moving_bones = {"femur.vtk"};
    e.attachments = e.muscle + "_attachments.csv";
    e.line_model = "LHDL_hip_r.osim";
    e.fibres = "kukacka";
    return e;
}

/// The published run literally: centre 6 mm off the head, whatever collides at the start is fixed, no outlines.
Experiment literal(Experiment e, const char* key, const char* title, const char* marks) {
    e.key = key;
    e.title = title;
    e.attachments.clear();
    e.line_model.clear();
    e.surface_fibres.clear();
    e.stand_in.clear();
    e.centre = Vec3(146, 238, -431);
    e.methods = MethodChoice::published;
    e.fibres = "none";
    e.published = marks;
    return e;
}

/// Moment arms about another axis of the hip, with the program's own method alone.
Experiment sweep(Experiment e, const char* key, const char* title, MotionKind motion) {
    e.key = key;
    e.title = title;
    e.figures.clear();
    e.stand_in.clear();
    e.published.clear();
    e.motion = motion;
    e.methods = MethodChoice::first;
    return e;
}

std::vector<Experiment> make_rows() {
    std::vector<Experiment> rows;

    Experiment box;
    box.key = "squish-box";
    box.title = "Box squeezed to a tenth of the gap";
    box.figures = "1, 2, 11, 14, 17";
    box.muscle = "box";
    box.muscle_file = "box.vtk";
    box.moving_bones = {"plate_top.vtk"};
    box.fixed_bones = {"plate_bottom.vtk"};
    box.stand_in = "squish-box";
    box.motion = MotionKind::squeeze;
    box.published = "box";
    rows.push_back(box);

    Experiment iliacus = hip("iliacus", "Iliacus in hip flexion", "3, 4, 12, 15, 18, 20", "iliacus");
    iliacus.stand_in = "hip";
    iliacus.from = StandardView::anterior;
    iliacus.published = "iliacus";
    iliacus.flexor = true;
    rows.push_back(iliacus);

    Experiment gluteus =
        hip("gluteus_maximus", "Gluteus maximus in hip flexion", "5, 6, 13, 16, 19, 21", "gluteus_maximus");
    gluteus.surface_fibres = "gluteus_maximus_surface_fibres.vtk";
    gluteus.stand_in = "hip";
    gluteus.from = StandardView::posterior;
    gluteus.published = "gluteus_maximus_fibres";
    rows.push_back(gluteus);

    Experiment medius = hip("gluteus_medius", "Gluteus medius in hip flexion", "7", "gluteus_medius");
    medius.from = StandardView::right;
    medius.published = "gluteus_medius";
    rows.push_back(medius);

    Experiment adductor = hip("adductor_brevis", "Adductor brevis in hip flexion", "8", "adductor_brevis");
    adductor.from = StandardView::anterior;
    adductor.published = "adductor_brevis";
    adductor.flexor = true;
    rows.push_back(adductor);

    Experiment chmd = gluteus;
    chmd.key = "gluteus_maximus-chmd";
    chmd.title = "Gluteus maximus with fibres by CHMD";
    chmd.figures = "10, 21";
    chmd.methods = MethodChoice::first;
    chmd.fibres = "chmd";
    chmd.published.clear();
    chmd.line_model.clear();
    // CHMD needs superficial fibres, which the muscles of the embedded hip have not.
    chmd.stand_in = "two-heads";
    chmd.stand_in_muscle = "two_heads";
    rows.push_back(chmd);

    rows.push_back(sweep(iliacus, "iliacus-adduction", "Iliacus in hip adduction", MotionKind::adduction));
    rows.push_back(sweep(iliacus, "iliacus-rotation", "Iliacus in internal rotation", MotionKind::rotation));
    rows.push_back(sweep(gluteus, "gluteus_maximus-adduction", "Gluteus maximus in hip adduction",
                         MotionKind::adduction));
    rows.push_back(sweep(gluteus, "gluteus_maximus-rotation", "Gluteus maximus in internal rotation",
                         MotionKind::rotation));

    rows.push_back(
        literal(iliacus, "iliacus-published", "Iliacus as the published program ran it", "iliacus"));
    rows.push_back(literal(gluteus, "gluteus_maximus-published",
                           "Gluteus maximus as the published program ran it", "gluteus_maximus"));
    rows.push_back(literal(medius, "gluteus_medius-published",
                           "Gluteus medius as the published program ran it", "gluteus_medius"));
    rows.push_back(literal(adductor, "adductor_brevis-published",
                           "Adductor brevis as the published program ran it", "adductor_brevis"));
    return rows;
}

} // namespace

const char* to_text(MotionKind motion) {
    switch (motion) {
    case MotionKind::flexion:
        return "hip flexion";
    case MotionKind::squeeze:
        return "squeezing";
    case MotionKind::adduction:
        return "hip adduction";
    case MotionKind::rotation:
        return "internal rotation";
    }
    return "";
}

const std::vector<Experiment>& experiments() {
    static const std::vector<Experiment> rows = make_rows();
    return rows;
}

const Experiment* find_experiment(const std::string& key) {
    for (const Experiment& e : experiments())
        if (e.key == key)
            return &e;
    return nullptr;
}

} // namespace fascicle::reproduce
