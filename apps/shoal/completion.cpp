#include "completion.h"

#include <shoal/core/params.h>

namespace shoal::app {

namespace {

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

std::vector<std::string> namesOf(const std::vector<VerbWords>& verbs) {
    std::vector<std::string> names;
    for (const VerbWords& verb : verbs) names.push_back(verb.name);
    return names;
}

// One line without what a shell would read: quotes, brackets, dollars.
std::string plain(const std::string& sentence) {
    std::string text;
    for (const char c : sentence.substr(0, 100)) {
        if (c == '\'')
            text += "\xe2\x80\x99";  // the typographic apostrophe
        else if (std::string("\"`$\\[]\n").find(c) == std::string::npos)
            text += c;
    }
    return text;
}

std::string bashScript(const std::vector<VerbWords>& verbs) {
    std::string script = R"sh(# bash completion for shoal: `eval "$(shoal completion bash)"`, or save it in
# ~/.local/share/bash-completion/completions/shoal
_shoal() {
    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} verb= words= values= word
    for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
        [[ $word != -* ]] && { verb=$word; break; }
    done
    COMPREPLY=()
    case "$verb" in
)sh";
    for (const VerbWords& verb : verbs) {
        std::vector<std::string> all;
        std::string valued;
        for (const OptionWords& option : verb.options) {
            all.insert(all.end(), option.names.begin(), option.names.end());
            std::string names;
            for (const std::string& name : option.names) names += (names.empty() ? "" : "|") + name;
            if (!option.values.empty())
                valued += "                " + names + ") values='" + joined(option.values) + "' ;;\n";
        }
        script += "        " + verb.name + ")\n            words='" + joined(all) + "'\n";
        if (!valued.empty())
            script += "            case \"$prev\" in\n" + valued + "            esac ;;\n";
        else
            script += "            ;;\n";
    }
    script += "        *) words='" + joined(namesOf(verbs)) + R"( --help --version' ;;
    esac
    if [[ -n $values ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$values" -- "$cur")
    elif [[ -z $verb || $cur == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur")
    else
        compopt -o filenames 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -f -- "$cur")
    fi
}
complete -F _shoal shoal
)";
    return script;
}

std::string zshScript(const std::vector<VerbWords>& verbs) {
    std::string script =
        "#compdef shoal\n# zsh completion for shoal: save it as _shoal in a folder of $fpath, or `eval \"$(shoal "
        "completion zsh)\"`\n"
        "_shoal() {\n    local -a verbs\n    verbs=(\n";
    for (const VerbWords& verb : verbs) script += "        '" + verb.name + ":" + plain(verb.sentence) + "'\n";
    script +=
        "    )\n    if (( CURRENT == 2 )); then\n        _describe 'verb' verbs\n        return\n    fi\n    case "
        "\"$words[2]\" in\n";
    for (const VerbWords& verb : verbs) {
        script += "        " + verb.name + ")\n            _arguments \\\n";
        for (const OptionWords& option : verb.options) {
            for (const std::string& name : option.names) {
                script += "                '" + name + "[" + plain(option.sentence) + "]";
                if (!option.values.empty())
                    script += ":value:(" + joined(option.values) + ")";
                else if (option.takesValue)
                    script += ":value:_files";
                script += "' \\\n";
            }
        }
        script += "                '*:file:_files' ;;\n";
    }
    return script +
           "    esac\n}\nif [[ ${funcstack[1]} == _shoal ]]; then _shoal \"$@\"; else compdef _shoal shoal; fi\n";
}

std::string fishScript(const std::vector<VerbWords>& verbs) {
    std::string script =
        "# fish completion for shoal: `shoal completion fish | source`, or save it in\n"
        "# ~/.config/fish/completions/shoal.fish\n"
        "complete -c shoal -n __fish_use_subcommand -l help -d 'tells more'\n"
        "complete -c shoal -n __fish_use_subcommand -l version -d 'version and commit'\n";
    for (const VerbWords& verb : verbs)
        script +=
            "complete -c shoal -f -n __fish_use_subcommand -a " + verb.name + " -d '" + plain(verb.sentence) + "'\n";
    for (const VerbWords& verb : verbs) {
        for (const OptionWords& option : verb.options) {
            script += "complete -c shoal -n '__fish_seen_subcommand_from " + verb.name + "'";
            for (const std::string& name : option.names)
                script += name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
            if (!option.values.empty())
                script += " -x -a '" + joined(option.values) + "'";
            else if (option.takesValue)
                script += " -r";
            script += " -d '" + plain(option.sentence) + "'\n";
        }
    }
    return script;
}

}  // namespace

Result<std::string> completionScript(const std::string& shell, const std::vector<VerbWords>& verbs) {
    if (shell == "bash") return bashScript(verbs);
    if (shell == "zsh") return zshScript(verbs);
    if (shell == "fish") return fishScript(verbs);
    return usageError("completion: " + unknownWord("shell", shell, {"bash", "zsh", "fish"}) +
                      ", expected bash, zsh or fish");
}

}  // namespace shoal::app
