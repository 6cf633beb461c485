#pragma once
// Simulations as folders below OUT/work, so that an interrupted `reproduce` goes on where it was cut off.

#include "fascicle/base/blob_store.hpp"
#include "fascicle/base/job_control.hpp"
#include "fascicle/scene/scene.hpp"

#include <filesystem>
#include <memory>

namespace fascicle::reproduce {

/// One simulation that is wanted.
struct RunRequest {
    ScenePtr scene; ///< with one muscle, and with its method's parameters
    std::vector<std::string> notes;
    int every = 0; ///< surfaces of every K-th frame are kept, the last always; 0: no surfaces, tables alone
};

/// 32 hexadecimal digits of everything that the run's numbers depend on: meshes, attachments, fibres, motion frame by frame, parameters,
/// what is kept, notes, and `program`. Not of paths, threads or time.
std::string run_key(const RunRequest& request, const std::string& program);

/// Version of the program and a hash of its file, where the system tells which that is: a program that was built anew makes its runs anew.
std::string program_identity();

/// OUT/work/<key>: a run folder as `simulate` leaves it, and run.json with the sizes and hashes of its files.
class WorkFolder {
public:
    /// program: program_identity(), or another for tests. threads change no number.
    WorkFolder(std::filesystem::path folder, std::string program, int threads);

    std::filesystem::path folder_of(const RunRequest& request) const;
    /// Whether a whole run is there: run.json can be read, and every file has the size and the hash that it says.
    bool has(const RunRequest& request) const;

    struct Made {
        std::filesystem::path folder;
        bool reused = false;
    };
    /// The folder of the run; simulates when it is not there or damaged, and removes what is damaged first. control: stage "solve", share of
    /// the frames. Throws Cancelled (nothing is left of this run then), and Error when the run fails.
    Made ensure(const RunRequest& request, const JobControl& control) const;

    /// Removes runs that another program made: this one can never use them. What cannot be removed stays.
    void remove_outdated() const;

    /// Distance grids: of the user's cache, else of this object.
    const std::shared_ptr<BlobStore>& cache() const { return cache_; }

private:
    void simulate(const RunRequest& request, const std::filesystem::path& folder, const std::string& key,
                  const JobControl& control) const;

    std::filesystem::path folder_;
    std::string program_;
    int threads_;
    std::shared_ptr<BlobStore> cache_;
};

} // namespace fascicle::reproduce
