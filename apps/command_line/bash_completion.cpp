#include "completions.h"
#include "row_texts.h"

namespace steradian::app {
namespace {

// The patterns "VERB NAME" of an option's names.
std::string patterns(const VerbRow& verb, const OptionRow& option) {
  std::string text;
  for (const std::string& name : option.names) text += (text.empty() ? "\"" : " | \"") + verb.name + " " + name + "\"";
  return text;
}

std::string names_of(const std::vector<OptionRow>& options) {
  std::vector<std::string> names;
  for (const OptionRow& option : options) names.insert(names.end(), option.names.begin(), option.names.end());
  return joined(names, " ");
}

}  // namespace

// A word without an answer is left to readline, which completes names of files.
std::string bash_completion(const ProgramRow& program) {
  std::string verbs, after, options;
  for (const VerbRow& verb : program.verbs) {
    verbs += verb.name + " ";
    std::string arguments;
    for (const OptionRow& option : verb.options) {
      if (option.names.empty()) arguments += joined(option.words, " ");
      if (option.names.empty() || option.value.empty()) continue;
      after += "    " + patterns(verb, option) + ") " +
               (option.words.empty() ? "return" : "COMPREPLY=($(compgen -W \"" + joined(option.words, " ") + "\" -- \"$word\")); return") +
               " ;;\n";
    }
    options += "    " + verb.name + ") options=\"" + names_of(verb.options) + "\" arguments=\"" + arguments + "\" ;;\n";
  }
  return "# Completion of " + program.name + " for bash: `" + program.name + " completion bash` prints it.\n_" + program.name +
         "() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb=${COMP_WORDS[1]} options= arguments=\n"
         "  COMPREPLY=()\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    COMPREPLY=($(compgen -W \"" +
         verbs + names_of(program.options) +
         "\" -- \"$word\"))\n"
         "    return\n"
         "  fi\n"
         "  # --option=value comes in three words.\n"
         "  if [ \"$word\" = = ]; then\n"
         "    word=\n"
         "  elif [ \"$before\" = = ]; then\n"
         "    before=${COMP_WORDS[COMP_CWORD-2]}\n"
         "  fi\n"
         "  case \"$verb $before\" in\n" +
         after +
         "  esac\n"
         "  case \"$verb\" in\n" +
         options +
         "  esac\n"
         "  case \"$word\" in\n"
         "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
         "    *) COMPREPLY=($(compgen -W \"$arguments\" -- \"$word\")) ;;\n"
         "  esac\n"
         "}\n"
         "complete -o default -F _" +
         program.name + " " + program.name + "\n";
}

}  // namespace steradian::app
