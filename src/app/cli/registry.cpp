#include "app/cli/command.hpp"

namespace fascicle::app {

const std::vector<Command>& commands() {
    static const std::vector<Command> rows{
        {"scenes", "List the embedded scenes", "  fascicle scenes", add_scenes},
        {"info", "Tell what mesh files hold and what is wrong with them",
         "  fascicle info muscle.vtk bone.obj", add_info},
        {"convert", "Write a mesh file in another format",
         "  fascicle convert scan.stl scan.ply\n"
         "  fascicle convert femur.vtk femur.obj --units m\n"
         "  fascicle convert walk.mot walk.csv",
         add_convert},
        {"repair", "Make a closed, manifold, consistently oriented mesh of a broken one, or say why not",
         "  fascicle repair iliacus_raw.vtk iliacus.vtk\n"
         "  fascicle repair scan.obj muscle.vtk --fill 300 --smooth 10 --edge 2.5 --report muscle.json",
         add_repair},
        {"simulate", "Run a scene and write numbers, meshes and pictures",
         "  fascicle simulate --scene hip --export vtp,png,glb --out out/hip\n"
         "  fascicle simulate --muscle gluteus.vtk --bone pelvis.obj --moving-bone femur.vtk\n"
         "      --hinge \"143.86,243.37,-432.53;1,0,0\" --angle-deg -57.3 --out out/flexion\n"
         "  fascicle simulate --osim gait.osim --motion walk.mot --muscle glut_max1_r --out out/walk\n"
         "  fascicle simulate --osim hip.osim --motion flexion.mot --bone pelvis.obj=pelvis --bone "
         "femur.vtk=femur_r\n"
         "      --muscle gluteus.vtk=pelvis,femur_r --out out/hip\n"
         "  fascicle simulate --project my.fascicle --method classic --set solver.stiffness=0.8 --out out/my",
         add_simulate},
        {"fibres", "Decompose muscles into fibres at rest",
         "  fascicle fibres --scene hip --out out/fibres\n"
         "  fascicle fibres --muscle iliacus.vtk --bone pelvis.obj --moving-bone femur.vtk\n"
         "      --attachments iliacus=outlines.csv --set fibres.method=kukacka --set fibres.count=64 --out "
         "out/fibres",
         add_fibres},
#ifdef FASCICLE_HAS_VIEW
        {"render", "Draw frames of a run or of a source: a picture, numbered pictures, a GIF, a film",
         "  fascicle render out/hip --frame 100 --size 1200x800 --out hip.png\n"
         "  fascicle render out/hip --frames 0:300:5 --fps 20 --size 640x400 --out hip.gif\n"
         "  fascicle render --scene squish-box --frame 100 --colour strain --out box.png",
         add_render},
        {"report", "Write a run as one HTML page with pictures, plots and numbers",
         "  fascicle report out/hip --out hip.html\n"
         "  fascicle report --scene squish-box --out box.html",
         add_report},
#endif
        {"export", "Write a run for other programs: glTF, USD, OBJ, point caches, tables",
         "  fascicle export out/hip --out hip.glb --frames 0:300:5\n"
         "  fascicle export out/hip --as pc2 --out out/hip_cache\n"
         "  fascicle export from_blender.glb --as obj --out out/frames",
         add_export},
        {"lines", "Length and moment arms of line muscles of an OpenSim model",
         "  fascicle lines --osim hip.osim --motion flexion.mot --out out/lines\n"
         "  fascicle lines --osim gait.osim --motion walk.mot --coordinate knee_angle_r --export vtp --out "
         "out/walk\n"
         "  fascicle lines --osim hip.osim --motion flexion.mot --bone pelvis=pelvis.obj --bone "
         "femur_r=femur.vtk --out out/bones",
         add_lines},
        {"compare", "Tell how far two runs are apart, frame by frame",
         "  fascicle compare out/soft out/stiff --out out/difference", add_compare},
        {"bench", "Measure how fast everything is on this machine",
         "  fascicle bench\n"
         "  fascicle bench --case gluteus_maximus --part frames --json gluteus.json",
         add_bench},
#ifdef FASCICLE_HAS_VIEW
        {"reproduce", "Repeat every figure and table of Cervenka & Kohout 2020, with the rivals beside",
         "  fascicle reproduce --data ../shared/data --out out/paper\n"
         "  fascicle reproduce --only iliacus,gluteus_maximus --methods xpbd,classic --out out/hip\n"
         "  fascicle reproduce --short --out out/short",
         add_reproduce},
#endif
        {"parameters", "List every parameter of a simulation",
         "  fascicle parameters\n"
         "  fascicle parameters --markdown > docs/parameters.md",
         add_parameters},
        {"templates", "List the fibre templates, check a file of your own, draw them",
         "  fascicle templates\n"
         "  fascicle templates my_template.json --thumbnails out",
         add_templates},
    };
    return rows;
}

} // namespace fascicle::app
