// shoal completion: what the shell offers after `shoal` and Tab, made from the command line's own description.
#pragma once

#include <string>
#include <vector>

#include <shoal/core/result.h>

namespace shoal::app {

struct OptionWords {
    std::vector<std::string> names;  // "--output", "-o"
    std::string sentence;
    bool takesValue = false;
    std::vector<std::string> values;  // the words it may be; empty: a file or free text
};
struct VerbWords {
    std::string name, sentence;
    std::vector<OptionWords> options;
};

// The script for "bash", "zsh" or "fish"; a usage error for any other shell.
Result<std::string> completionScript(const std::string& shell, const std::vector<VerbWords>& verbs);

}  // namespace shoal::app
